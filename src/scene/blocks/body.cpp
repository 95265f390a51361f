#include <algorithm>
#include <cmath>

#include "scene/blocks/blocks.hpp"
#include "scene/suggest.hpp"

namespace hibi {

namespace {

/// Two neighbours then stay at least a fifth of a spacing apart (spacings).
constexpr double most_jitter = 0.4;

Block<Lattice> lattice_keys() {
    Block<Lattice> lattice("lattice", KeyBlock::Form::inner, "Arrangement of the particles of a body.");
    lattice.add("angle", &Lattice::angle, "", "of the rows to the x axis, counter-clockwise", R"("30 deg")");
    lattice.add("jitter", &Lattice::jitter, "",
                "each particle is moved by up to this many spacings in x and in y, at random", "0.1",
                at_least(0), at_most(most_jitter, "beyond that two particles could meet"));
    lattice.add("seed", &Lattice::seed, "", "another number, another jitter", "7", at_least(0));
    return lattice;
}

/// The spacing next to the given one of which both sides of a box hold a whole number; 0 where none is near.
double fitting_spacing(const Vec<2>& size, double spacing) {
    double best = 0;
    const int most = static_cast<int>(std::min(1e5, 4 * size.x() / spacing + 4));
    for (int columns = 1; columns <= most; ++columns) {
        const double s = size.x() / columns, rows = size.y() / s;
        if (rows < 0.5 || std::abs(rows - std::round(rows)) > 1e-9 * rows) continue;
        if (best == 0 || std::abs(s - spacing) < std::abs(best - spacing)) best = s;
    }
    return best;
}

void check_box(const Box<2>& box, double spacing, const std::string& path, Problems& problems) {
    const Vec<2> size = box.high - box.low;
    for (int axis = 0; axis < 2; ++axis) {
        const double count = size[axis] / spacing;
        if (count > 0.5 && std::abs(count - std::round(count)) < 1e-6 * std::max(1.0, count)) continue;
        const double fits = fitting_spacing(size, spacing);
        problems.add(
            path + "/spacing",
            fmt::format("[[body]] spacing: the box is {:g} m x {:g} m, {:.6g} x {:.6g} spacings of {:g} m; "
                        "both need to be whole numbers",
                        size.x(), size.y(), size.x() / spacing, size.y() / spacing, spacing),
            fits > 0 ? fmt::format("the nearest spacing that fits: \"{:.12g} m\"", fits)
                     : fmt::format("a box of {:g} m x {:g} m would fit",
                                   std::max(1.0, std::round(size.x() / spacing)) * spacing,
                                   std::max(1.0, std::round(size.y() / spacing)) * spacing));
        return;
    }
}

void check_material(const BodySpec& body, const std::vector<Material>& materials, const std::string& path,
                    Problems& problems) {
    std::vector<std::string> known;
    for (const Material& m : materials) known.push_back(m.name);
    if (!problems.fine(path + "/material") || std::ranges::find(known, body.material) != known.end()) return;
    const auto near = nearest(body.material, known);
    problems.add(path + "/material", fmt::format("[[body]] material: no material \"{}\"", body.material),
                 near            ? fmt::format("did you mean \"{}\"?", *near)
                 : known.empty() ? "write [material.NAME]"
                                 : "known: " + list_of(known));
}

void check_bodies(const Scene& scene, Problems& problems) {
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySpec& body = scene.bodies[b];
        const std::string path = fmt::format("body/{}", b);
        const double spacing = body.spacing(Vec3::Zero(), 0);
        check_material(body, scene.materials, path, problems);
        const auto* box = std::get_if<Box<2>>(&body.shape.form);
        const auto* difference = std::get_if<Difference<2>>(&body.shape.form);
        if (difference && !difference->parts.empty())
            box = std::get_if<Box<2>>(&difference->parts.front().form);
        if (box && !body.lattice.is_turned() && problems.fine(path + "/spacing") &&
            problems.fine(path + "/box") && problems.fine(path + "/shape") &&
            problems.fine(path + "/difference"))
            check_box(*box, spacing, path, problems);
        for (std::size_t k = 0; k < body.bonded_to.size(); ++k) {
            const std::string& other = body.bonded_to[k];
            const std::string place = fmt::format("{}/bonded_to/{}", path, k);
            const auto above = scene.bodies.begin() + static_cast<std::ptrdiff_t>(b);
            const auto found = std::find_if(scene.bodies.begin(), above,
                                            [&](const BodySpec& its) { return its.name == other; });
            if (found == above)
                problems.add(place, fmt::format("[[body]] bonded_to: no body \"{}\" above this one", other));
            else if (std::abs(found->spacing(Vec3::Zero(), 0) - spacing) > 1e-9 * spacing &&
                     problems.fine(path + "/spacing"))
                problems.add(place, fmt::format("[[body]] bonded_to: \"{}\" has another spacing", other),
                             "bodies that are bonded share one spacing");
        }
    }
}

}  // namespace

SceneBlock body_block() {
    Block<BodySpec> body("body", KeyBlock::Form::list, "A body, of exactly one shape.");
    body.keys.required = true;
    body.name("for messages and for `body = ` elsewhere", R"("plate")");
    body.add("material", &BodySpec::material, "", "a name of [material]", R"("concrete")", required);
    body.include(shape_keys(true), &BodySpec::shape);
    body.add("spacing", &BodySpec::spacing, "m", "distance of neighbouring particles", R"("1 m")", required,
             above(0));
    body.table(lattice_keys(), &BodySpec::lattice, "how the particles are arranged; absent: in rows along x",
               R"({ angle = "30 deg", jitter = 0.1 })");
    body.add("bonded_to", &BodySpec::bonded_to, "",
             "bodies above this one, of the same spacing, that it is glued to", R"(["plate"])");
    body.vector("velocity", &BodySpec::velocity, "m/s", "at the start", R"(["3 m/s", "0 m/s"])");
    body.add("spin", &BodySpec::spin, "1/s", "at the start, about its centre of mass, counter-clockwise",
             R"("2 rad/s")");
    SceneBlock result = list_block(body, &Scene::bodies);
    result.checks.push_back(check_bodies);
    return result;
}

}  // namespace hibi
