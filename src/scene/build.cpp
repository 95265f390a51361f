#include "scene/build.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "physics/time_step.hpp"
#include "physics/weights.hpp"

namespace hibi {

namespace {

constexpr double most_particles = 2e7;

double spacing_of(const BodySpec& body) { return body.spacing(Vec3::Zero(), 0); }

bool geometry_is_fine(const Scene& scene, const Problems& problems) {
    if (scene.bodies.empty() || problems.concerns("model/influence") || problems.concerns("model/thickness"))
        return false;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        for (const char* key :
             {"shape", "box", "disc", "ring", "polygon", "difference", "spacing", "bonded_to"})
            if (problems.concerns(fmt::format("body/{}/{}", b, key))) return false;
    return true;
}

/// Index of a name in a list of things with names; 0 where it is not there, which is told elsewhere.
template <class Items>
int index_of(const Items& items, const std::string& name) {
    for (std::size_t i = 0; i < items.size(); ++i)
        if (items[i].name == name) return static_cast<int>(i);
    return 0;
}

bool boxes_overlap(const Box<2>& a, const Box<2>& b, double slack) {
    return ((a.low.array() < b.high.array() - slack) && (b.low.array() < a.high.array() - slack)).all();
}

/// Bodies of which one holds particles of the other, or, of boxes, that overlap at all.
bool overlap(const Model<2>& model, const Body<2>& a, const Body<2>& b) {
    const double slack = 1e-6 * std::min(a.spacing, b.spacing);
    if (!boxes_overlap(bounding_box(a.shape), bounding_box(b.shape), slack)) return false;
    if (std::holds_alternative<Box<2>>(a.shape.form) && std::holds_alternative<Box<2>>(b.shape.form))
        return true;
    const auto& X = model.particles.reference_position;
    for (int i = a.begin; i < a.end; ++i)
        if (inside(b.shape, X[i])) return true;
    for (int i = b.begin; i < b.end; ++i)
        if (inside(a.shape, X[i])) return true;
    return false;
}

/// Fills the bodies. False where that failed.
bool add_bodies(const Scene& scene, Built<2>& built, Problems& problems) {
    bool fine = true;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySpec& spec = scene.bodies[b];
        const std::string path = fmt::format("body/{}", b);
        const Box<2> box = bounding_box(spec.shape);
        const double cells = (box.high - box.low).prod() / std::pow(spacing_of(spec), 2);
        if (!(cells < most_particles)) {
            problems.add(
                path + "/spacing",
                fmt::format("[[body]] spacing: body \"{}\" would have {:.2g} particles", spec.name, cells),
                fmt::format("at most {:.2g}", most_particles));
            fine = false;
            continue;
        }
        Body<2> body;
        body.name = spec.name;
        body.shape = spec.shape;
        body.spacing = spacing_of(spec);
        body.material = index_of(scene.materials, spec.material);
        for (const std::string& other : spec.bonded_to)
            body.bonded_to.push_back(index_of(scene.bodies, other));
        add_body(built.model, std::move(body));
        const Body<2>& added = built.model.bodies.back();
        const int count = added.end - added.begin;
        if (count == 0) {
            problems.add(path, fmt::format("[[body]]: body \"{}\" holds no particle", spec.name),
                         fmt::format("its shape is {:.3g} m x {:.3g} m, the spacing {:.3g} m",
                                     (box.high - box.low).x(), (box.high - box.low).y(), body.spacing));
            fine = false;
        }
        built.lattice_area_error.push_back(count * added.spacing * added.spacing / measure(spec.shape) - 1);
        for (std::size_t a = 0; fine && a < b; ++a)
            if (overlap(built.model, built.model.bodies[a], added))
                problems.add(path,
                             fmt::format("[[body]]: body \"{}\" overlaps body \"{}\"", spec.name,
                                         scene.bodies[a].name),
                             "bodies may touch, not overlap");
    }
    return fine;
}

void set_velocities(const Scene& scene, Model<2>& model, Problems& problems) {
    Particles<2>& particles = model.particles;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySpec& spec = scene.bodies[b];
        const Body<2>& body = model.bodies[b];
        Vec<2> centre = Vec<2>::Zero();
        for (int i = body.begin; i < body.end; ++i) centre += particles.reference_position[i];
        centre /= std::max(1, body.end - body.begin);
        for (int i = body.begin; i < body.end; ++i) {
            const Vec<2>& X = particles.reference_position[i];
            const Vec<2> arm = X - centre;
            particles.velocity[i] =
                Vec<2>(spec.velocity[0](to_3d<2>(X), 0), spec.velocity[1](to_3d<2>(X), 0)) +
                spec.spin * Vec<2>(-arm.y(), arm.x());
            if (!particles.velocity[i].allFinite()) {
                problems.add(
                    fmt::format("body/{}/velocity", b),
                    fmt::format("[[body]] velocity is not finite at ({:g} m, {:g} m)", X.x(), X.y()));
                break;
            }
        }
    }
}

std::vector<int> selected(const Model<2>& model, const Selection& selection) {
    std::vector<int> particles;
    for (int i = 0; i < model.particles.count(); ++i)
        if (selection(to_3d<2>(model.particles.reference_position[i]), model.particles.body[i]))
            particles.push_back(i);
    return particles;
}

/// The particles of a selection; an empty one is reported.
std::vector<int> select(const Model<2>& model, const Selection& selection, const std::string& path,
                        const std::string& block, Problems& problems) {
    std::vector<int> particles = selected(model, selection);
    if (!particles.empty()) return particles;
    Vec<2> low = Vec<2>::Constant(INFINITY), high = -low;
    for (int i = 0; i < model.particles.count(); ++i) {
        if (selection.body >= 0 && selection.body != model.particles.body[i]) continue;
        low = low.cwiseMin(model.particles.reference_position[i]);
        high = high.cwiseMax(model.particles.reference_position[i]);
    }
    problems.add(path + "/where", fmt::format("{} where: selects no particle", block),
                 fmt::format("particle centres lie within x = {:g} ... {:g} m, y = {:g} ... {:g} m", low.x(),
                             high.x(), low.y(), high.y()));
    return particles;
}

Vec3 outward_of(const std::string& face) {
    return face == "left"     ? Vec3(-1, 0, 0)
           : face == "right"  ? Vec3(1, 0, 0)
           : face == "bottom" ? Vec3(0, -1, 0)
                              : Vec3(0, 1, 0);
}

/// The particles that carry a face of a box, and, per particle, the part of its area vector that points out
/// of that face (m^2). A particle that the face takes neighbours from has other weights, and so has every
/// particle bonded to it: the vectors differ from zero up to two influence radii deep, and only all together
/// they are the face.
void select_face(const Model<2>& model, const std::vector<Vec<2>>& areas, const Body<2>& body,
                 const Vec<2>& outward, Load& load, std::vector<double>& share) {
    const auto& box = std::get<Box<2>>(body.shape.form);
    const Vec<2> size = box.high - box.low;
    const double depth = std::min(2 * model.influence * body.spacing, std::abs(size.dot(outward)) / 2);
    const Vec<2> corner = outward.sum() > 0 ? box.high : box.low;
    for (int i = body.begin; i < body.end; ++i) {
        if ((corner - model.particles.reference_position[i]).dot(outward) >= depth) continue;
        load.particles.push_back(i);
        share.push_back(areas[i].dot(outward));
    }
}

/// Total of a load at full ramp: what it is reported along. Zero where it has none.
Vec3 resultant(const Model<2>& model, const Load& load, double time) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < load.particles.size(); ++k) {
        const Vec3 X = to_3d<2>(model.particles.reference_position[load.particles[k]]);
        if (load.kind == Load::Kind::pressure)
            sum -= load.value[0](X, time) * load.share[k];
        else
            for (int axis = 0; axis < 2; ++axis)
                sum[axis] +=
                    (load.kind == Load::Kind::force ? load.share[k].x() : 1.0) * load.value[axis](X, time);
    }
    return sum;
}

/// Reports a value that is not finite somewhere on its particles, at one of a few times.
void check_finite(const Model<2>& model, const Load& load, double max_time, const std::string& path,
                  Problems& problems) {
    static constexpr const char* keys[] = {"force", "pressure", "displacement", "velocity"};
    const std::string key = keys[static_cast<int>(load.kind)];
    for (const double time : {0.0, load.ramp.duration / 2, load.ramp.duration, max_time / 2, max_time})
        for (const int i : load.particles) {
            const Vec3 X = to_3d<2>(model.particles.reference_position[i]);
            for (int axis = 0; axis < 2; ++axis)
                if (!std::isfinite(load.value[axis](X, time))) {
                    problems.add(path + "/" + key,
                                 fmt::format("[[load]] {} is not finite at ({:g} m, {:g} m), t = {:g} s", key,
                                             X.x(), X.y(), time));
                    return;
                }
        }
}

Load make_load(const Scene& scene, const Model<2>& model, const LoadSpec& spec, const std::string& path,
               const std::vector<Vec<2>>& areas, Problems& problems) {
    Load load;
    load.name = spec.name;
    load.kind = spec.kind;
    load.value = spec.value;
    load.driven = spec.driven;
    load.ramp.duration = spec.ramp;
    load.primary = spec.primary;
    load.no_fail = spec.no_fail;
    if (spec.face) {
        const Vec3 outward = outward_of(*spec.face);
        std::vector<double> area;
        select_face(model, areas, model.bodies[spec.face_body], outward.head<2>(), load, area);
        const double sum = std::accumulate(area.begin(), area.end(), 0.0);
        for (const double A : area)
            load.share.push_back(load.kind == Load::Kind::pressure ? Vec3(A * outward) : Vec3(A / sum, 0, 0));
        load.direction = load.kind == Load::Kind::pressure ? Vec3(Vec3::Zero() - outward) : outward;
    } else {
        load.particles = select(model, *spec.where, path, "[[load]]", problems);
        if (load.kind == Load::Kind::pressure)
            for (const int i : load.particles) load.share.push_back(to_3d<2>(areas[i]));
        else
            load.share.assign(load.particles.size(),
                              Vec3(1.0 / static_cast<double>(load.particles.size()), 0, 0));
    }
    check_finite(model, load, scene.run.max_time, path, problems);
    const Vec3 total = resultant(model, load, load.ramp.duration);
    if (total.allFinite() && total.norm() > 0)
        load.direction = total.normalized();
    else if (!spec.face)
        load.direction = !load.driven[0] && load.driven[1] ? Vec3::UnitY() : Vec3::UnitX();
    return load;
}

/// A component of a particle that two supports or loads both prescribe.
void check_conflicts(const Built<2>& built, Problems& problems) {
    const int n = built.model.particles.count();
    std::array<std::vector<const std::string*>, 2> owner{std::vector<const std::string*>(n),
                                                         std::vector<const std::string*>(n)};
    for (const Hold& hold : built.physics.holds)
        for (const int i : hold.particles)
            for (int axis = 0; axis < 2; ++axis)
                if (hold.axes[axis]) owner[axis][i] = &hold.name;
    for (std::size_t l = 0; l < built.physics.loads.size(); ++l) {
        const Load& load = built.physics.loads[l];
        for (int axis = 0; axis < 2; ++axis)
            for (const int i : load.particles) {
                if (!load.driven[axis]) continue;
                if (owner[axis][i]) {
                    const Vec<2>& X = built.model.particles.reference_position[i];
                    problems.add(fmt::format("load/{}", l),
                                 fmt::format("[[load]]: \"{}\" and \"{}\" both prescribe the {} of the "
                                             "particle at ({:g} m, {:g} m)",
                                             load.name, *owner[axis][i], axis == 0 ? 'x' : 'y', X.x(), X.y()),
                                 "select apart, or make a direction \"free\"");
                    return;
                }
                owner[axis][i] = &load.name;
            }
    }
}

/// A particle of a part, hanging together by bonds, that is not held against all three motions of a rigid
/// body.
std::optional<int> free_particle(const Built<2>& built) {
    const Particles<2>& particles = built.model.particles;
    const Bonds& bonds = built.model.bonds;
    const int n = particles.count();
    std::vector<int> part(n);
    std::iota(part.begin(), part.end(), 0);
    const auto root = [&](int i) {
        while (part[i] != i) i = part[i] = part[part[i]];
        return i;
    };
    for (int b = 0; b < bonds.count(); ++b) part[root(bonds.first[b])] = root(bonds.second[b]);

    std::vector<std::array<bool, 3>> held(n);
    const auto hold = [&](const std::vector<int>& list, const std::array<bool, 3>& axes) {
        for (const int i : list)
            for (int axis = 0; axis < 2; ++axis) held[i][axis] |= axes[axis];
    };
    for (const Hold& h : built.physics.holds) hold(h.particles, h.axes);
    for (const Load& l : built.physics.loads) hold(l.particles, l.driven);

    std::vector<Vec<2>> centre(n, Vec<2>::Zero());
    std::vector<int> count(n, 0);
    for (int i = 0; i < n; ++i) {
        centre[root(i)] += particles.reference_position[i];
        ++count[root(i)];
    }
    // Each held component forbids one combination of the two translations and the rotation; a rotation is
    // measured by what it moves at one spacing from the centre of the part.
    std::vector<Mat<3>> forbidden(n, Mat<3>::Zero());
    for (int i = 0; i < n; ++i) {
        const int r = root(i);
        const Vec<2> arm = (particles.reference_position[i] - centre[r] / count[r]) / particles.spacing[i];
        for (int axis = 0; axis < 2; ++axis) {
            if (!held[i][axis]) continue;
            const Vec3 row = axis == 0 ? Vec3(1, 0, -arm.y()) : Vec3(0, 1, arm.x());
            forbidden[r] += row * row.transpose();
        }
    }
    for (int i = 0; i < n; ++i) {
        if (root(i) != i) continue;
        const Vec3 eigen =
            Eigen::SelfAdjointEigenSolver<Mat<3>>(forbidden[i], Eigen::EigenvaluesOnly).eigenvalues();
        if (!(eigen.minCoeff() > 1e-9 * std::max(1.0, eigen.maxCoeff()))) return i;
    }
    return {};
}

}  // namespace

Built<2> assemble(const Scene& scene, Problems& problems) {
    Built<2> built;
    if (!geometry_is_fine(scene, problems)) return built;
    Model<2>& model = built.model;
    model.materials = scene.materials;
    if (model.materials.empty()) model.materials.emplace_back();
    model.assumption = scene.assumption;
    model.thickness = scene.thickness;
    model.influence = scene.influence;
    if (!add_bodies(scene, built, problems)) return built;
    set_velocities(scene, model, problems);

    std::vector<Notch<2>> notches;
    std::vector<std::size_t> notch_index;
    for (std::size_t k = 0; k < scene.notches.size(); ++k) {
        if (problems.concerns(fmt::format("notch/{}", k))) continue;
        const auto& points = scene.notches[k].points;
        notches.push_back(scene.notches[k]);
        notch_index.push_back(k);
        for (std::size_t i = 1; i < points.size(); ++i)
            built.notches.push_back({to_3d<2>(points[i - 1]), to_3d<2>(points[i])});
    }
    const std::vector<int> cut = connect(model, notches);
    for (std::size_t k = 0; k < cut.size(); ++k)
        if (cut[k] == 0)
            problems.add(fmt::format("notch/{}", notch_index[k]),
                         fmt::format("[[notch]]: \"{}\" cuts no bond", notches[k].name),
                         "it lies outside the bodies, or in a corner where no bond is");

    Physics& physics = built.physics;
    physics.elasticity = scene.elasticity;
    physics.gravity = scene.gravity;
    if (scene.damping) physics.damping = scene.damping->damping;
    physics.time_step = scene.run.time_step;
    physics.time_step_factor = scene.run.time_step_factor;
    for (std::size_t k = 0; k < scene.fixes.size(); ++k) {
        const std::string path = fmt::format("fix/{}", k);
        if (problems.concerns(path)) continue;
        const FixSpec& fix = scene.fixes[k];
        physics.holds.push_back({fix.name, select(model, fix.where, path, "[[fix]]", problems), fix.axes});
    }
    const bool needs_areas = std::any_of(scene.loads.begin(), scene.loads.end(), [](const LoadSpec& load) {
        return load.face || load.kind == Load::Kind::pressure;
    });
    const std::vector<Vec<2>> areas = needs_areas ? nodal_areas(model) : std::vector<Vec<2>>{};
    for (std::size_t k = 0; k < scene.loads.size(); ++k) {
        const std::string path = fmt::format("load/{}", k);
        if (!problems.concerns(path))
            physics.loads.push_back(make_load(scene, model, scene.loads[k], path, areas, problems));
    }
    if (!problems.concerns("load") && !problems.concerns("fix")) {
        check_conflicts(built, problems);
        if (scene.damping && scene.damping->damping.ratio && problems.fine("damping/ratio"))
            if (const auto particle = free_particle(built)) {
                const Vec<2>& X = model.particles.reference_position[*particle];
                problems.add(
                    "damping/ratio",
                    fmt::format(
                        "[damping] ratio: the part of the model at ({:g} m, {:g} m) can move freely, so "
                        "there is no first mode",
                        X.x(), X.y()),
                    "give a rate, for example: rate = \"0.5 s^-1\"; or hold every part in [[fix]]");
            }
    }
    if (scene.run.time_step && problems.fine("run/time_step") && problems.fine("material") &&
        problems.fine("body")) {
        const double limit = stable_time_step(model, scene.elasticity);
        if (!(*scene.run.time_step <= limit))
            problems.add("run/time_step",
                         fmt::format("[run] time_step: {:.3g} s is above the stable {:.3g} s",
                                     *scene.run.time_step, limit),
                         "leave it out to have it chosen");
    }
    return built;
}

Built<2> build(const Scene& scene) {
    Problems problems;
    Built<2> built = assemble(scene, problems);
    if (!problems.errors().empty()) throw SceneErrors(scene.file.string(), "", problems.errors());
    return built;
}

Topology topology_of(const Scene& scene, const Built<2>& built) {
    const Particles<2>& particles = built.model.particles;
    Topology topology;
    topology.dimension = 2;
    topology.thickness = scene.thickness;
    for (const Vec<2>& X : particles.reference_position) topology.reference_position.push_back(to_3d<2>(X));
    topology.spacing = particles.spacing;
    topology.body = particles.body;
    for (const Body<2>& body : built.model.bodies) topology.body_names.push_back(body.name);
    topology.first = built.model.bonds.first;
    topology.second = built.model.bonds.second;
    topology.rest_length = built.model.bonds.rest_length;
    for (const Hold& hold : built.physics.holds)
        topology.supports.push_back({hold.name, hold.particles, hold.axes});
    static constexpr const char* kinds[] = {"force", "pressure", "displacement", "velocity"};
    for (std::size_t k = 0; k < built.physics.loads.size(); ++k) {
        const Load& load = built.physics.loads[k];
        LoadMark mark{load.name, kinds[static_cast<int>(load.kind)], load.particles, load.direction,
                      load.primary};
        if (scene.loads[k]
                .face) {  // drawn on the outermost row alone, though rows behind it carry some of it
            const Vec3 outward = outward_of(*scene.loads[k].face);
            mark.particles.clear();
            for (std::size_t i = 0; i < load.particles.size(); ++i)
                if ((load.kind == Load::Kind::force ? load.share[i].x() : load.share[i].dot(outward)) > 0)
                    mark.particles.push_back(load.particles[i]);
        }
        topology.loads.push_back(std::move(mark));
    }
    topology.notches = built.notches;
    return topology;
}

}  // namespace hibi
