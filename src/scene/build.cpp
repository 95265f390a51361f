#include "scene/build.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "elasticity/frequency.hpp"
#include "elasticity/weights.hpp"
#include "scene/build_loads.hpp"
#include "scene/build_supports.hpp"

namespace hibi {

namespace {

constexpr double most_particles = 2e7;

double spacing_of(const BodySpec& body) { return body.spacing(Vec3::Zero(), 0); }

bool geometry_is_fine(const Scene& scene, const Problems& problems) {
    if (scene.bodies.empty() || problems.concerns("model/influence") || problems.concerns("model/thickness"))
        return false;
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        for (const char* key :
             {"shape", "box", "disc", "ring", "polygon", "difference", "spacing", "lattice", "bonded_to"})
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
    const double slack = slack_per_spacing * std::min(a.spacing, b.spacing);
    if (!boxes_overlap(bounding_box(a.shape), bounding_box(b.shape), slack)) return false;
    if (std::holds_alternative<Box<2>>(a.shape.form) && std::holds_alternative<Box<2>>(b.shape.form))
        return true;
    const auto& X = model.particles.reference_position;
    for (int i = a.begin; i < a.end; ++i)
        if (inside(b.shape, X[i], -slack)) return true;
    for (int i = b.begin; i < b.end; ++i)
        if (inside(a.shape, X[i], -slack)) return true;
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
        body.lattice = spec.lattice;
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
        const Content<2> whole = content(spec.shape);
        Vec<2> centre = Vec<2>::Zero();
        for (int i = added.begin; i < added.end; ++i)
            centre += built.model.particles.reference_position[i] - whole.centroid;
        built.lattice_area_error.push_back(count * added.spacing * added.spacing / whole.measure - 1);
        built.lattice_centre_error.push_back(centre / std::max(1, count));
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
            particles.initial_velocity[i] =
                Vec<2>(spec.velocity[0](to_3d<2>(X), 0), spec.velocity[1](to_3d<2>(X), 0)) +
                spec.spin * Vec<2>(-arm.y(), arm.x());
            if (!particles.initial_velocity[i].allFinite()) {
                problems.add(
                    fmt::format("body/{}/velocity", b),
                    fmt::format("[[body]] velocity is not finite at ({:g} m, {:g} m)", X.x(), X.y()));
                break;
            }
        }
    }
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
    if (scene.run.statics)
        physics.statics = Statics{.duration = scene.run.max_time,
                                  .load_steps = scene.run.statics->load_steps,
                                  .sequential = scene.run.statics->sequential};
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
        const bool ratio = scene.damping && scene.damping->damping.ratio && problems.fine("damping/ratio");
        const std::optional<int> particle =
            ratio || scene.run.statics ? free_particle(built) : std::optional<int>{};
        if (particle) {
            const Vec<2>& X = model.particles.reference_position[*particle];
            const std::string part =
                fmt::format("the part of the model at ({:g} m, {:g} m) can move freely", X.x(), X.y());
            if (ratio)
                problems.add("damping/ratio",
                             fmt::format("[damping] ratio: {}, so there is no first mode", part),
                             "give a rate, for example: rate = \"0.5 s^-1\"; or hold every part in [[fix]]");
            else
                problems.add("run/method", fmt::format("[run] method: {}, so it has no equilibrium", part),
                             "hold every part in [[fix]]");
        }
    }
    if (scene.run.time_step && problems.fine("run/time_step") && problems.fine("material") &&
        problems.fine("body") && !scene.run.statics) {
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
        // Drawn on the outermost row alone, though rows behind it carry some of a face load.
        if (const auto& face = scene.loads[k].face) {
            const Body<2>& body = built.model.bodies[scene.loads[k].face_body];
            std::erase_if(mark.particles, [&](int i) {
                return depth_behind(body, *face, particles.reference_position[i]) > body.spacing;
            });
        }
        topology.loads.push_back(std::move(mark));
    }
    topology.notches = built.notches;
    return topology;
}

}  // namespace hibi
