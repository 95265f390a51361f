#include "scene/checks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

/// What can happen in a scene.
struct Possible {
    bool breaks = false, loaded = false, held = false;
};

/// Reports a moment that cannot come, or that makes no sense here.
void check_moment(const GivenMoment& given, const Possible& possible, Problems& problems) {
    const auto& [path, label, moment, ends_something, is_picture] = given;
    if (!problems.fine(path)) return;
    if (!moment.event) {
        if (moment.offset < 0 || (ends_something && moment.offset == 0))
            problems.add(path, fmt::format("{}: {} s lies before the run", label, moment.offset));
        return;
    }
    if (is_picture) return;
    const EventName event = *moment.event;
    if (ends_something && (event == EventName::start || event == EventName::end)) {
        problems.add(path, fmt::format("{}: \"{}\" cannot end it", label, to_string(event)),
                     "first_break, peak_load, separation, or a time");
        return;
    }
    const bool needs_break = event == EventName::first_break || event == EventName::separation;
    const bool needs_load = event == EventName::peak_load || event == EventName::separation;
    std::string lacks, hint;
    if (needs_break && !possible.breaks) {
        lacks = "no material of this scene can break";
        hint = "add break_strain or fracture_energy to a material";
    } else if (needs_load && !possible.loaded) {
        lacks = "this scene has no [[load]]";
    } else if (event == EventName::separation && !possible.held) {
        lacks = "this scene holds no particle, so nothing can be separated from a support";
        hint = "add a [[fix]]";
    }
    if (!lacks.empty())
        problems.add(path, fmt::format("{}: {} cannot happen: {}", label, to_string(event), lacks), hint);
}

/// Whether it starts with a velocity or a spin.
bool moves(const BodySpec& body) {
    return body.spin != 0 || !body.velocity[0].is_constant() || !body.velocity[1].is_constant() ||
           body.velocity[0](Vec3::Zero(), 0) != 0 || body.velocity[1](Vec3::Zero(), 0) != 0;
}

/// What has no meaning where nothing moves in time.
void check_statics(const Scene& scene, Problems& problems) {
    if (!scene.run.statics) return;
    const auto refuse = [&](const std::string& path, const std::string& what, const std::string& hint) {
        problems.add(path, what + ": [run] method = \"static\" knows no motion in time", hint);
    };
    if (scene.elasticity == Elasticity::thesis)
        problems.add("model/elasticity",
                     "[model] elasticity: method = \"static\" is for moment-matched alone",
                     "leave one of the two out");
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        const std::string path = fmt::format("body/{}", k);
        if (problems.fine(path + "/velocity") && problems.fine(path + "/spin") && moves(scene.bodies[k]))
            refuse(path, fmt::format("body \"{}\" has a velocity or spin", scene.bodies[k].name),
                   "leave it out");
    }
    for (std::size_t k = 0; k < scene.loads.size(); ++k) {
        const std::string path = fmt::format("load/{}", k);
        if (scene.loads[k].kind == Load::Kind::velocity)
            refuse(path + "/velocity", "[[load]] velocity", "prescribe a displacement, with a ramp");
        if (scene.loads[k].until)
            refuse(path + "/until", "[[load]] until", "leave it out; a value over t can fall again");
    }
    if (scene.damping) refuse("damping", "[damping]", "leave the block out");
    if (scene.run.time_step) refuse("run/time_step", "[run] time_step", "load_steps says how many there are");
    if (scene.run.time_step_factor)
        refuse("run/time_step_factor", "[run] time_step_factor", "load_steps says how many there are");
}

void check_that_something_happens(const Scene& scene, Problems& problems) {
    if (scene.loads.empty() && !scene.gravity && std::ranges::none_of(scene.bodies, moves) &&
        problems.fine("load") && problems.fine("body") && problems.fine("gravity"))
        problems.add("load",
                     "nothing would happen: no [[load]], no [gravity], no body with a velocity or spin",
                     "add a [[load]]");
}

}  // namespace

void check_scene(const Scene& scene, const std::vector<GivenMoment>& moments, Problems& problems) {
    for (const SceneBlock& block : bound_blocks())
        for (const auto& check : block.checks) check(scene, problems);

    Possible possible;
    for (const BodySpec& body : scene.bodies)
        for (const Material& material : scene.materials)
            possible.breaks |= material.name == body.material && material.can_break();
    // A material that could not be read might have been one that breaks.
    possible.breaks |= problems.concerns("material") || problems.concerns("body");
    possible.loaded = !scene.loads.empty() || problems.concerns("load");
    possible.held = !scene.fixes.empty() || problems.concerns("fix");
    for (const GivenMoment& given : moments) check_moment(given, possible, problems);
    check_that_something_happens(scene, problems);
    check_statics(scene, problems);
}

}  // namespace hibi
