#include "app/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "app/estimate.hpp"
#include "app/quasi_static.hpp"
#include "app/run.hpp"
#include "base/units.hpp"
#include "physics/damage.hpp"
#include "physics/simulation.hpp"

namespace hibi {

namespace {

/// What is found out about a scene by building it.
struct Facts {
    Estimate estimate;
    std::optional<double> period;           ///< of the first mode (s)
    double damping_ratio = 0;               ///< of that mode
    bool period_left_out = false;           ///< for the time it would take
    std::optional<std::string> collapse{};  ///< a static run's, in its first load steps
};

std::string si(double value, const std::string& unit) { return format_si(value, unit, 4, true); }

std::string axes_text(const std::array<bool, 3>& axes) {
    std::string text;
    for (int axis = 0; axis < 2; ++axis)
        if (axes[axis]) text += text.empty() ? std::string(1, static_cast<char>('x' + axis)) : " and y";
    return text;
}

std::string moment_text(const Moment& moment) {
    if (!moment.event) return si(moment.offset, "s");
    std::string text = to_string(*moment.event);
    std::replace(text.begin(), text.end(), '_', ' ');
    if (moment.offset != 0)
        text += fmt::format(" {} {}", moment.offset < 0 ? "-" : "+", si(std::abs(moment.offset), "s"));
    return text;
}

std::string value_text(const Field& field, const std::string& unit) {
    return field.is_constant() ? si(field(Vec3::Zero(), 0), unit) : field.text();
}

/// How far the particles' centre of mass lies from the centroid of the shape.
std::string centre_text(const Vec<2>& error, double spacing) {
    if (error.norm() < 0.005 * spacing) return "";
    return fmt::format(", centre of mass off by ({:.2f}, {:.2f}) spacings", error.x() / spacing,
                       error.y() / spacing);
}

std::string load_text(const LoadSpec& spec, const Load& load) {
    static constexpr const char* kinds[] = {"force", "pressure", "displacement", "velocity"};
    static constexpr const char* units[] = {"N", "Pa", "m", "m/s"};
    const int kind = static_cast<int>(load.kind);
    std::string value = value_text(load.value[0], units[kind]);
    if (load.kind != Load::Kind::pressure) {
        const auto component = [&](int axis) {
            const bool free = load.kind != Load::Kind::force && !load.driven[axis];
            return free ? std::string("free") : value_text(load.value[axis], units[kind]);
        };
        value = fmt::format("({}, {})", component(0), component(1));
    }
    return fmt::format("{} {} on {} particles{}; {}{}{}", kinds[kind], value, load.particles.size(),
                       spec.face ? fmt::format(" behind the {} face", *spec.face) : "",
                       spec.ramp > 0 ? fmt::format("full after {}", si(spec.ramp, "s")) : "suddenly applied",
                       spec.until ? ", until " + moment_text(*spec.until) : "",
                       load.primary ? "; drives the curve" : "");
}

/// Loads that come on too fast for a static answer.
void add_ramp_notes(const Built<2>& built, double period, double ratio, std::vector<std::string>& notes) {
    for (const Load& load : built.physics.loads) {
        const double ramp = load.ramp.duration;
        if (load.kind == Load::Kind::velocity || (load.kind == Load::Kind::displacement && ramp == 0))
            continue;
        const std::string note =
            ramp > 0 ? fast_ramp(load.name, ramp, ramp, period, ratio)
                     : fmt::format(
                           "load \"{}\" is suddenly applied: the body swings to as much as twice its "
                           "static state; for a static answer: ramp = {}",
                           load.name, format_si(slow_ramp_periods * period, "s", 2));
        if (!note.empty()) notes.push_back(note);
    }
    if (built.physics.gravity)
        notes.push_back(
            "gravity acts from the start: the body swings to as much as twice what its weight strains it at rest; "
            "loads of the same moment meet it swinging");
}

/// Strains below this are those of brittle materials, which are crushed at far more than they are torn at.
constexpr double brittle_strain = 0.01;

void add_compression_notes(const Scene& scene, std::vector<std::string>& notes) {
    for (const Material& m : scene.materials)
        if (m.break_strain && *m.break_strain < brittle_strain && !m.tension_only)
            notes.push_back(fmt::format(
                "[material.{}] break_strain: bonds that are shortened by {:.2g} % break too; for concrete, stone or "
                "glass, which bear far more in compression: tension_only = true",
                m.name, 100 * *m.break_strain));
}

/// Corners between what is held and what is free, and tips of notches, where strain grows without end as the
/// particles get smaller: with a limit of the strain alone, so does what breaks first.
void add_spacing_note(const Scene& scene, const Built<2>& built, std::vector<std::string>& notes) {
    const bool limited = std::ranges::any_of(
        scene.materials, [](const Material& m) { return m.break_strain && !m.fracture_energy; });
    if (!limited) return;
    const auto& holds = built.physics.holds;
    const auto clamp = std::ranges::find_if(holds, [](const Hold& h) { return h.axes[0] && h.axes[1]; });
    if (built.model.bonds_cut == 0 && clamp == holds.end()) return;
    notes.push_back(fmt::format(
        "break_strain: the strain at {} grows as the particles get smaller, so the load at first break "
        "depends on the spacing; hibi converge shows how much",
        built.model.bonds_cut > 0 ? "the tip of a notch" : fmt::format("the support \"{}\"", clamp->name)));
}

/// Bodies that are to be glued and are not.
void add_glue_notes(const Model<2>& model, std::vector<std::string>& notes) {
    std::set<std::pair<int, int>> glued;
    for (int b = 0; b < model.bonds.count(); ++b)
        glued.insert(std::minmax({model.particles.body[model.bonds.first[b]],
                                  model.particles.body[model.bonds.second[b]]}));
    for (int b = 0; b < static_cast<int>(model.bodies.size()); ++b)
        for (const int other : model.bodies[b].bonded_to)
            if (!glued.contains({other, b}))
                notes.push_back(fmt::format(
                    "body \"{}\": bonded_to holds \"{}\", but no bond joins the two; bonds reach across no more "
                    "than half a spacing of empty space",
                    model.bodies[b].name, model.bodies[other].name));
}

/// What a user might not expect of a scene that is right.
std::vector<std::string> notes_on(const Scene& scene, const Built<2>& built, const Facts& facts) {
    std::vector<std::string> notes;
    if (facts.collapse) notes.push_back(*facts.collapse);
    if (facts.period) add_ramp_notes(built, *facts.period, facts.damping_ratio, notes);
    if (facts.period_left_out)
        notes.push_back(fmt::format(
            "the first mode was not looked for, so ramps are not judged: {} particles would take too long; a "
            "larger spacing has nearly the same period",
            built.model.particles.count()));
    add_spacing_note(scene, built, notes);
    add_compression_notes(scene, notes);
    const auto primary =
        std::find_if(scene.loads.begin(), scene.loads.end(), [](const LoadSpec& l) { return l.primary; });
    const bool forced = primary != scene.loads.end() &&
                        (primary->kind == Load::Kind::force || primary->kind == Load::Kind::pressure) &&
                        primary->value[0].is_constant() && primary->value[1].is_constant() && !primary->until;
    if (scene.run.until && scene.run.until->event == EventName::peak_load && forced)
        notes.push_back(
            "[run] until: an applied force never falls, so peak_load is not confirmed before max_time");
    for (std::size_t b = 0; b < scene.bodies.size(); ++b)
        if (std::abs(built.lattice_area_error[b]) > 0.05)
            notes.push_back(fmt::format(
                "body \"{}\": its particles cover {:.1f} % {} than its shape; a smaller spacing helps",
                scene.bodies[b].name, 100 * std::abs(built.lattice_area_error[b]),
                built.lattice_area_error[b] > 0 ? "more" : "less"));
    const bool breaks = std::any_of(built.model.materials.begin(), built.model.materials.end(),
                                    [](const Material& m) { return m.can_break(); });
    for (const Material& m : scene.materials)
        if (m.fracture_energy && !fracture_is_calibrated(m, scene.assumption, scene.influence))
            notes.push_back(fmt::format(
                "[material.{}] fracture_energy: its limit is calibrated for influence 1.5 to 3.1 and "
                "poissons_ratio 0 to 0.45; the nearest calibrated value is used",
                m.name));
    int alone = 0;
    for (int i = 0; i < built.model.particles.count(); ++i)
        alone += built.model.bonds.start[i] == built.model.bonds.start[i + 1];
    if (alone > 0)
        notes.push_back(
            fmt::format("{} particles have no bond: does a notch or a slit run through their centres?", alone));
    add_glue_notes(built.model, notes);
    for (const Body<2>& body : built.model.bodies) {
        Vec<2> low = built.model.particles.reference_position[body.begin], high = low;
        for (int i = body.begin; i < body.end; ++i) {
            low = low.cwiseMin(built.model.particles.reference_position[i]);
            high = high.cwiseMax(built.model.particles.reference_position[i]);
        }
        if (body.end - body.begin > 1 && (high - low).minCoeff() < body.spacing / 2)
            notes.push_back(fmt::format(
                "body \"{}\" is one particle wide: it stretches like a bar, but its bending stiffness is not "
                "that of a beam; use four particles or more over the width",
                body.name));
    }
    if (!breaks) notes.push_back("no material can break: give one a break_strain or a fracture_energy");
    return notes;
}

void print_report(const Scene& scene, const Built<2>& built, const Simulation<2>& simulation,
                  const Facts& facts) {
    const Model<2>& model = built.model;
    const Estimate& estimate = facts.estimate;
    const auto row = [](const std::string& name, const std::string& text) {
        fmt::print("{:<11} {}\n", name, text);
    };
    fmt::print("{}\n{}\n\n", scene.title, scene.file.string());
    row("model", fmt::format("2-D, {}, {} thick; bonds within {} spacings; {} elasticity",
                             scene.assumption == Assumption::plane_stress ? "plane stress" : "plane strain",
                             si(scene.thickness, "m"), scene.influence,
                             scene.elasticity == Elasticity::thesis ? "thesis" : "moment-matched"));
    for (const Parameter& p : scene.params) row("parameter", fmt::format("{} = {}", p.name, p.text));
    row("particles", fmt::format("{}", model.particles.count()));
    row("bonds",
        fmt::format(
            "{}{}{}", model.bonds.count(),
            scene.notches.empty() ? "" : fmt::format(", and {} cut by notches", model.bonds_cut),
            model.bonds_over_gaps == 0
                ? ""
                : fmt::format(", and {} not made, for they would cross empty space", model.bonds_over_gaps)));
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        const Body<2>& body = model.bodies[b];
        double mass = 0;
        for (int i = body.begin; i < body.end; ++i) mass += model.particles.mass[i];
        row("body",
            fmt::format("{}: {}, {} particles of {}, {:.4g} kg; area and mass {:+.2f} %{}", body.name,
                        model.materials[body.material].name, body.end - body.begin, si(body.spacing, "m"),
                        mass, std::round(1e4 * built.lattice_area_error[b]) / 100 + 0.0,
                        centre_text(built.lattice_centre_error[b], body.spacing)));
    }
    for (const Hold& hold : built.physics.holds)
        row("support", fmt::format("{}: {} particles held in {}", hold.name, hold.particles.size(),
                                   axes_text(hold.axes)));
    for (std::size_t l = 0; l < scene.loads.size(); ++l)
        row("load",
            fmt::format("{}: {}", scene.loads[l].name, load_text(scene.loads[l], built.physics.loads[l])));
    if (scene.damping)
        row("damping",
            fmt::format("rate {}/s{}{}", format_si(simulation.damping_rate(), "", 4, true),
                        scene.damping->damping.ratio
                            ? fmt::format(", ratio {} of the first mode", *scene.damping->damping.ratio)
                            : "",
                        scene.damping->until ? ", until " + moment_text(*scene.damping->until) : ""));
    if (facts.period)
        row("first mode",
            fmt::format("period {}, with held and driven particles at rest", si(*facts.period, "s")));
    row("run", fmt::format("{}until {}",
                           scene.run.until ? "until " + moment_text(*scene.run.until) + ", at most " : "",
                           si(scene.run.max_time, "s")));
    if (scene.run.statics)
        row("load step",
            fmt::format("{}, {} of them", si(simulation.time_step(), "s"), scene.run.statics->load_steps));
    else
        row("time step", fmt::format("{}, {:.2f} of the stable {}", si(simulation.time_step(), "s"),
                                     simulation.time_step() / simulation.stable_time_step(),
                                     si(simulation.stable_time_step(), "s")));
    int number = 0;
    for (const std::string& stage : simulation.stage_names()) {
        ++number;
        row(number == 1 ? "each step" : "", fmt::format("{}. {}", number, stage));
    }
    row("film", fmt::format("{} frames, {} x {}, {} per second", scene.movie.frames(), scene.view.width,
                            scene.view.height, scene.movie.fps));
    row("at most",
        fmt::format(
            "{} steps, {:.3g} s to simulate, about {:.3g} s to draw; {:.0f} MB of memory, {:.0f} MB on disk",
            estimate.steps, estimate.solve_seconds, estimate.draw_seconds, estimate.memory / 1e6,
            estimate.disk / 1e6));
    for (const std::string& note : notes_on(scene, built, facts)) row("note", note);
    fmt::print("\nThe scene with every default filled in, in SI units:\n\n{}", write_scene(scene));
}

void print_json(const Scene& scene, const Built<2>& built, const Simulation<2>& simulation,
                const Facts& facts) {
    using nlohmann::ordered_json;
    const Model<2>& model = built.model;
    const Estimate& estimate = facts.estimate;
    ordered_json bodies = ordered_json::array(), supports = ordered_json::array(),
                 loads = ordered_json::array();
    for (std::size_t b = 0; b < model.bodies.size(); ++b) {
        const Body<2>& body = model.bodies[b];
        bodies.push_back(
            {{"name", body.name},
             {"material", model.materials[body.material].name},
             {"particles", body.end - body.begin},
             {"spacing", body.spacing},
             {"area_error", built.lattice_area_error[b]},
             {"centre_error", {built.lattice_centre_error[b].x(), built.lattice_centre_error[b].y()}}});
    }
    for (const Hold& hold : built.physics.holds)
        supports.push_back({{"name", hold.name}, {"particles", hold.particles.size()}});
    for (const Load& load : built.physics.loads)
        loads.push_back({{"name", load.name},
                         {"particles", load.particles.size()},
                         {"direction", {load.direction.x(), load.direction.y()}},
                         {"primary", load.primary}});
    const ordered_json json{
        {"scene", {{"title", scene.title}, {"hash", scene_hash(scene)}, {"toml", write_scene(scene)}}},
        {"counts",
         {{"particles", model.particles.count()},
          {"bonds", model.bonds.count()},
          {"bonds_cut", model.bonds_cut},
          {"bonds_over_gaps", model.bonds_over_gaps},
          {"frames", scene.movie.frames()}}},
        {"bodies", bodies},
        {"supports", supports},
        {"loads", loads},
        {"stages", simulation.stage_names()},
        {"time_step", simulation.time_step()},
        {"stable_time_step",
         scene.run.statics ? ordered_json() : ordered_json(simulation.stable_time_step())},
        {"first_period", facts.period ? ordered_json(*facts.period) : ordered_json()},
        {"estimate",
         {{"steps", estimate.steps},
          {"solve_seconds", estimate.solve_seconds},
          {"draw_seconds", estimate.draw_seconds},
          {"memory", estimate.memory},
          {"disk", estimate.disk}}},
        {"notes", notes_on(scene, built, facts)}};
    fmt::print("{}\n", json.dump(2));
}

}  // namespace

int check_command(const CheckOptions& options) {
    const auto [scene, built] = read_and_build(options.scene, options.overrides);
    Simulation<2> simulation(built.model, built.physics);
    require_separable(scene, Watch<2>(simulation));
    require_steps_that_end(scene, simulation);
    Facts facts;
    facts.period_left_out = period_takes_too_long(simulation, options.most_particles_for_period);
    if (!facts.period_left_out) facts.period = first_period(built, simulation);
    if (facts.period) facts.damping_ratio = damping_ratio(simulation, *facts.period);
    facts.estimate = estimate_run(scene, built, simulation);
    if (simulation.broken() == 0) facts.collapse = simulation.collapse();
    // The stages are asked of a simulation that has made steps, the values are those of the scene.
    (options.json ? print_json : print_report)(scene, built, simulation, facts);
    return 0;
}

}  // namespace hibi
