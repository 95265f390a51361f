#include "scene/checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "scene/suggest.hpp"

namespace hibi {

namespace {

/// Two neighbours then stay at least a fifth of a spacing apart (spacings).
constexpr double most_jitter = 0.4;

/// Reports a value that is not above zero.
void want_positive(Problems& problems, const std::string& path, const std::string& label, double value,
                   const std::string& hint = {}) {
    if (problems.fine(path) && !(value > 0))
        problems.add(path, fmt::format("{} needs to be above 0; found {}", label, value), hint);
}

void check_model(const Scene& scene, Problems& problems) {
    want_positive(problems, "model/thickness", "[model] thickness", scene.thickness);
    const double influence = scene.influence;
    if (!problems.fine("model/influence")) return;
    const std::string label = fmt::format("[model] influence: {}", influence);
    if (influence < std::sqrt(2.0) - 1e-6) {
        problems.add(
            "model/influence",
            fmt::format(
                "{} is below sqrt 2 = 1.414: without the diagonal bonds the lattice would shear freely",
                label),
            "the default is 2.1");
        return;
    }
    if (influence > 8) {
        problems.add("model/influence", fmt::format("{} is above 8, hundreds of bonds per particle", label),
                     "the default is 2.1");
        return;
    }
    // Where all is jittered, hardly a pair is at such a distance.
    const bool regular = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                     [](const BodySpec& body) { return body.lattice.jitter == 0; });
    for (int i = 1; regular && i <= 8; ++i)
        for (int j = 0; j <= i; ++j)
            if (std::abs(influence - std::hypot(i, j)) < 1e-6) {
                problems.add(
                    "model/influence",
                    fmt::format("{} is a distance of the lattice: rounding would decide who is a neighbour",
                                label),
                    fmt::format("for example {:.2f}", std::hypot(i, j) + 0.1));
                return;
            }
}

void check_materials(const Scene& scene, Problems& problems) {
    for (std::size_t k = 0; k < scene.materials.size(); ++k) {
        const Material& m = scene.materials[k];
        const std::string path = fmt::format("material/{}", k), title = fmt::format("[material.{}] ", m.name);
        want_positive(problems, path + "/density", title + "density", m.density);
        want_positive(problems, path + "/youngs_modulus", title + "youngs_modulus", m.youngs_modulus);
        if (problems.fine(path + "/poissons_ratio") && !(m.poissons_ratio > -1 && m.poissons_ratio < 0.5))
            problems.add(path + "/poissons_ratio",
                         fmt::format("{}poissons_ratio needs to be above -1 and below 0.5; found {}", title,
                                     m.poissons_ratio),
                         m.poissons_ratio >= 0.5 ? "nearly incompressible: 0.49" : "");
        if (m.break_strain)
            want_positive(problems, path + "/break_strain", title + "break_strain", *m.break_strain);
        if (m.fracture_energy)
            want_positive(problems, path + "/fracture_energy", title + "fracture_energy", *m.fracture_energy);
        if (m.break_strain && m.fracture_energy)
            problems.add(path + "/fracture_energy", title + "has both break_strain and fracture_energy",
                         "keep one of them");
        if (m.weibull) {
            want_positive(problems, path + "/weibull/shape", title + "weibull shape", m.weibull->shape);
            if (!m.can_break() && problems.fine(path))
                problems.add(path + "/weibull", title + "weibull scatters a limit that is not there",
                             "add break_strain or fracture_energy");
        }
    }
}

/// Names go into messages, file headers and CSV columns.
template <class Items>
void check_names(const Items& items, const std::string& block, Problems& problems) {
    std::set<std::string> seen;
    for (std::size_t i = 0; i < items.size(); ++i) {
        const std::string path = fmt::format("{}/{}/name", block, i);
        const std::string& name = items[i].name;
        if (name.empty() || name.find_first_of(",\"\n\r\t") != std::string::npos)
            problems.add(path,
                         fmt::format("[[{}]] name needs letters, without comma, quote or line break", block));
        else if (!seen.insert(name).second)
            problems.add(path, fmt::format("[[{}]] name \"{}\" is taken already", block, name),
                         "give it another name");
    }
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

void check_bodies(const Scene& scene, Problems& problems) {
    std::vector<std::string> materials;
    for (const Material& m : scene.materials) materials.push_back(m.name);
    for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
        const BodySpec& body = scene.bodies[b];
        const std::string path = fmt::format("body/{}", b);
        if (problems.fine(path + "/material") &&
            std::find(materials.begin(), materials.end(), body.material) == materials.end()) {
            const auto near = nearest(body.material, materials);
            problems.add(path + "/material",
                         fmt::format("[[body]] material: no material \"{}\"", body.material),
                         near                ? fmt::format("did you mean \"{}\"?", *near)
                         : materials.empty() ? "write [material.NAME]"
                                             : "known: " + list_of(materials));
        }
        const double spacing = body.spacing(Vec3::Zero(), 0);
        want_positive(problems, path + "/spacing", "[[body]] spacing", spacing);
        if (problems.fine(path + "/lattice/jitter") &&
            !(body.lattice.jitter >= 0 && body.lattice.jitter <= most_jitter))
            problems.add(path + "/lattice/jitter",
                         fmt::format("[[body]] lattice jitter needs to be 0 to {}; found {}", most_jitter,
                                     body.lattice.jitter),
                         "beyond that two particles could meet");
        const auto* box = std::get_if<Box<2>>(&body.shape.form);
        if (const auto* difference = std::get_if<Difference<2>>(&body.shape.form))
            box = std::get_if<Box<2>>(&difference->parts.front().form);
        if (box && !body.lattice.is_turned() && problems.fine(path + "/spacing") &&
            problems.fine(path + "/box") && problems.fine(path + "/shape") &&
            problems.fine(path + "/difference"))
            check_box(*box, spacing, path, problems);
        for (std::size_t k = 0; k < body.bonded_to.size(); ++k) {
            const std::string& other = body.bonded_to[k];
            const std::string place = fmt::format("{}/bonded_to/{}", path, k);
            const auto found =
                std::find_if(scene.bodies.begin(), scene.bodies.end(),
                             [&](const BodySpec& candidate) { return candidate.name == other; });
            if (found == scene.bodies.end() || found - scene.bodies.begin() >= static_cast<std::ptrdiff_t>(b))
                problems.add(place, fmt::format("[[body]] bonded_to: no body \"{}\" above this one", other));
            else if (std::abs(found->spacing(Vec3::Zero(), 0) - spacing) > 1e-9 * spacing &&
                     problems.fine(path + "/spacing"))
                problems.add(place, fmt::format("[[body]] bonded_to: \"{}\" has another spacing", other),
                             "bodies that are bonded share one spacing");
        }
    }
}

void check_notches(const Scene& scene, Problems& problems) {
    for (std::size_t k = 0; k < scene.notches.size(); ++k) {
        const std::string path = fmt::format("notch/{}", k);
        const auto& points = scene.notches[k].points;
        for (std::size_t i = 1; i < points.size(); ++i)
            if (points[i] == points[i - 1]) problems.add(path, "[[notch]]: two points in a row are the same");
    }
}

struct Possible {
    bool breaks = false, loaded = false, held = false;
};

/// Reports a moment that cannot come, or that makes no sense here.
void check_moment(const Possible& possible, const std::optional<Moment>& moment, bool ends_something,
                  const std::string& path, const std::string& label, Problems& problems) {
    if (!moment || !problems.fine(path)) return;
    if (!moment->event) {
        if (moment->offset < 0 || (ends_something && moment->offset == 0))
            problems.add(path, fmt::format("{}: {} s lies before the run", label, moment->offset));
        return;
    }
    const EventName event = *moment->event;
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

void check_loads(const Scene& scene, const Possible& possible, Problems& problems) {
    bool primary = false;
    for (std::size_t k = 0; k < scene.loads.size(); ++k) {
        const LoadSpec& load = scene.loads[k];
        const std::string path = fmt::format("load/{}", k);
        if (problems.fine(path + "/ramp") && load.ramp < 0)
            problems.add(path + "/ramp", "[[load]] ramp needs a time of 0 or more");
        if (load.primary && primary)
            problems.add(path + "/primary", "[[load]] primary: another load is primary already",
                         "one load drives the curve");
        primary |= load.primary;
        check_moment(possible, load.until, true, path + "/until", "[[load]] until", problems);
        if (load.face && load.kind != Load::Kind::force && load.kind != Load::Kind::pressure)
            problems.add(path + "/face", "[[load]] face goes with force or pressure",
                         "select the particles by where = ...");
        if (load.face && problems.fine(path + "/face") && problems.fine(path + "/body") &&
            load.face_body >= 0 && problems.fine(fmt::format("body/{}", load.face_body)) &&
            !std::holds_alternative<Box<2>>(scene.bodies[load.face_body].shape.form))
            problems.add(
                path + "/face",
                fmt::format("[[load]] face: body \"{}\" is no box", scene.bodies[load.face_body].name),
                "select the particles by where = ...");
    }
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

void check_rest(const Scene& scene, const Possible& possible, Problems& problems) {
    if (scene.damping) {
        if (scene.damping->damping.ratio)
            want_positive(problems, "damping/ratio", "[damping] ratio", *scene.damping->damping.ratio);
        if (scene.damping->damping.rate)
            want_positive(problems, "damping/rate", "[damping] rate", *scene.damping->damping.rate);
        check_moment(possible, scene.damping->until, true, "damping/until", "[damping] until", problems);
    }
    want_positive(problems, "run/max_time", "[run] max_time", scene.run.max_time);
    if (scene.run.time_step)
        want_positive(problems, "run/time_step", "[run] time_step", *scene.run.time_step);
    if (scene.run.time_step_factor && problems.fine("run/time_step_factor") &&
        !(*scene.run.time_step_factor > 0 && *scene.run.time_step_factor < 1))
        problems.add("run/time_step_factor",
                     fmt::format("[run] time_step_factor needs to be above 0 and below 1; found {}",
                                 *scene.run.time_step_factor),
                     "beyond 1 a run is not stable");
    if (scene.run.time_step && scene.run.time_step_factor)
        problems.add("run/time_step_factor", "[run] has both time_step and time_step_factor",
                     "keep one of them");
    check_moment(possible, scene.run.until, true, "run/until", "[run] until", problems);

    want_positive(problems, "view/magnify", "[view] magnify", scene.view.magnify);
    want_positive(problems, "movie/duration", "[movie] duration", scene.movie.duration);
    if (problems.fine("movie/duration") && problems.fine("movie/fps") &&
        scene.movie.duration * scene.movie.fps > 1e6)
        problems.add("movie/duration", fmt::format("[movie] duration: {:.3g} frames are too many",
                                                   scene.movie.duration * scene.movie.fps));
    for (std::size_t k = 0; k < scene.movie.slow.size(); ++k) {
        const SlowSpec& slow = scene.movie.slow[k];
        const std::string path = fmt::format("movie/slow/{}", k);
        check_moment(possible, slow.around, false, path + "/around", "[movie] slow around", problems);
        want_positive(problems, path + "/span", "[movie] slow span", slow.span);
        want_positive(problems, path + "/rate", "[movie] slow rate", slow.rate,
                      "0.1 is ten times as slow as the rest");
    }
    if (scene.movie.hold && problems.fine("movie/hold") && problems.fine("movie/duration") &&
        !(*scene.movie.hold >= 0 && *scene.movie.hold < scene.movie.duration))
        problems.add("movie/hold",
                     fmt::format("[movie] hold needs to be shorter than the film, {} s; found {} s",
                                 scene.movie.duration, *scene.movie.hold));
    want_positive(problems, "movie/flash", "[movie] flash", scene.movie.flash);
    check_moment(possible, scene.movie.poster, false, "movie/poster", "[movie] poster", problems);
    // A picture of an event that cannot happen is left out like that of one that did not.
    const auto check_moments = [&](const std::vector<Moment>& moments, const char* path, const char* label) {
        for (std::size_t k = 0; k < moments.size(); ++k)
            check_moment({true, true, true}, moments[k], false, fmt::format("{}/{}", path, k), label,
                         problems);
    };
    check_moments(scene.strip.at, "strip/at", "[strip] at");
    check_moments(scene.test.frames, "test/frames", "[test] frames");

    const bool moving = std::any_of(scene.bodies.begin(), scene.bodies.end(), moves);
    if (scene.loads.empty() && !scene.gravity && !moving && problems.fine("load") && problems.fine("body") &&
        problems.fine("gravity"))
        problems.add("load",
                     "nothing would happen: no [[load]], no [gravity], no body with a velocity or spin",
                     "add a [[load]]");
}

}  // namespace

void check_scene(const Scene& scene, Problems& problems) {
    check_model(scene, problems);
    check_materials(scene, problems);
    check_bodies(scene, problems);
    check_notches(scene, problems);
    check_names(scene.bodies, "body", problems);
    check_names(scene.notches, "notch", problems);
    check_names(scene.fixes, "fix", problems);
    check_names(scene.loads, "load", problems);

    Possible possible;
    for (const BodySpec& body : scene.bodies)
        for (const Material& material : scene.materials)
            possible.breaks |= material.name == body.material && material.can_break();
    // A material that could not be read might have been one that breaks.
    possible.breaks |= problems.concerns("material") || problems.concerns("body");
    possible.loaded = !scene.loads.empty() || problems.concerns("load");
    possible.held = !scene.fixes.empty() || problems.concerns("fix");
    check_loads(scene, possible, problems);
    check_rest(scene, possible, problems);
    check_statics(scene, problems);
}

}  // namespace hibi
