#include "scene/build_loads.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "scene/load_direction.hpp"

namespace hibi {

std::vector<int> select(const Model<2>& model, const Selection& selection, const std::string& path,
                        const std::string& block, Problems& problems) {
    std::vector<int> particles;
    for (int i = 0; i < model.particles.count(); ++i)
        if (selection(to_3d<2>(model.particles.reference_position[i]), model.particles.spacing[i],
                      model.particles.body[i]))
            particles.push_back(i);
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

namespace {

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
                 const std::string& face, Load& load, std::vector<double>& share) {
    const Vec<2> outward = outward_of(face).head<2>();
    const auto& box = std::get<Box<2>>(body.shape.form);
    const double depth =
        std::min(2 * model.influence * body.spacing, std::abs((box.high - box.low).dot(outward)) / 2);
    const double slack = slack_per_spacing * body.spacing;
    for (int i = body.begin; i < body.end; ++i) {
        if (depth_behind(body, face, model.particles.reference_position[i]) >= depth - slack) continue;
        load.particles.push_back(i);
        share.push_back(areas[i].dot(outward));
    }
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

}  // namespace

double depth_behind(const Body<2>& body, const std::string& face, const Vec<2>& X) {
    const auto& box = std::get<Box<2>>(body.shape.form);
    const Vec<2> outward = outward_of(face).head<2>();
    return ((outward.sum() > 0 ? box.high : box.low) - X).dot(outward);
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
        select_face(model, areas, model.bodies[spec.face_body], *spec.face, load, area);
        // A turned or jittered lattice has no clean edge: what its areas miss of the side is made up for.
        if (const Body<2>& body = model.bodies[spec.face_body]; body.lattice != Lattice{}) {
            const auto& box = std::get<Box<2>>(body.shape.form);
            const Vec<2> size = box.high - box.low;
            const double whole = model.thickness * (outward.x() != 0 ? size.y() : size.x());
            const double found = std::accumulate(area.begin(), area.end(), 0.0);
            for (double& A : area) A *= whole / found;
        }
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
    const double end = spec.until && !spec.until->event ? std::min(spec.until->offset, scene.run.max_time)
                                                        : scene.run.max_time;
    if (const auto direction = load_direction(model, load, end))
        load.direction = *direction;
    else if (!spec.face)
        load.direction = !load.driven[0] && load.driven[1] ? Vec3::UnitY() : Vec3::UnitX();
    return load;
}

}  // namespace hibi
