#include "solve/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/units.hpp"
#include "measure/run_monitor.hpp"
#include "record/leftovers.hpp"
#include "record/provenance.hpp"
#include "record/summary.hpp"
#include "scene/scene_file.hpp"
#include "solve/recorder.hpp"
#include "solve/run_to_end.hpp"
#include "solve/warnings.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

/// Beyond this the balance is not merely off: the run makes energy from nothing.
constexpr double runaway_imbalance = 1;
constexpr double trusted_imbalance = 0.02;

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// By which a run knows its scene again.
std::string place(const fs::path& scene) {
    return is_stream(scene) ? scene.string() : fs::weakly_canonical(scene).string();
}

/// Moves the simulation to its end and records it. Returns why it stopped early, if it did.
std::optional<std::string> solve(const Scene& scene, Simulation& simulation, RunMonitor& monitor,
                                 Recorder& recorder, bool quiet, StageTimes* profile) {
    Progress progress("solving", "steps", quiet);
    const auto after_step = [&]() -> std::optional<std::string> {
        recorder.look();
        if (!std::isfinite(recorder.imbalance()) ||
            (monitor.settled() && recorder.imbalance() > runaway_imbalance))
            return fmt::format(
                "step {}, t = {:.6g} s: the energy balance ran away (imbalance {:.0f} %), fastest is {}; {}",
                simulation.steps(), simulation.time(), 100 * recorder.imbalance(), simulation.fastest_particle(),
                simulation.likely_cause());
        if (simulation.steps() % 64 == 0 || scene.run.statics)
            progress.at(simulation.time() / scene.run.max_time, static_cast<double>(simulation.steps()),
                        fmt::format("t = {}, {} bonds broken", format_si(simulation.time(), "s"),
                                    simulation.broken()));
        return {};
    };
    return run_to_end(scene, simulation, monitor, after_step, profile);
}

/// The stages of the simulation with those of its recording around them.
StageTimes stages_of(const Simulation& simulation) {
    std::vector<std::string> stages = simulation.stage_names();
    stages.insert(stages.begin(), "setup");
    stages.insert(stages.end(), {"watch", "take states", "history", "wait for the writer", "write states"});
    return StageTimes(stages);
}

/// What is known before the first step. Until the end stands here, the run counts as interrupted.
RunSummary summary_at_start(const Scene& scene, const Simulation& simulation,
                            const SimulateOptions& options) {
    RunSummary summary;
    summary.title = scene.title;
    summary.parameters = {options.overrides.begin(), options.overrides.end()};
    summary.command = options.command;
    summary.scene_hash = scene_hash(scene);
    summary.scene_file = place(scene.file);
    summary.version = HIBI_VERSION;
    summary.particles = simulation.particle_count();
    summary.bonds = simulation.bond_count();
    summary.threads = threads();
    summary.time_step = simulation.time_step();
    summary.stopped = "it is still running, or was killed";
    summary.trusted = false;
    return summary;
}

void add_results(RunSummary& summary, const Simulation& simulation, RunMonitor& monitor) {
    summary.broken = simulation.broken();
    summary.steps = simulation.steps();
    summary.end_time = simulation.time();
    summary.events = monitor.events();
    summary.crack = monitor.crack();
    summary.top_crack_speed = monitor.top_crack_speed();
    summary.fragments = monitor.fragments();
    summary.worst_imbalance = monitor.worst_imbalance();
    summary.imbalance_at_first_break = monitor.imbalance_before_first_break();
    summary.trusted = !summary.stopped && summary.worst_imbalance <= trusted_imbalance;
}

}  // namespace

void refuse_other_scene(const fs::path& folder, const Scene& scene, bool force) {
    std::error_code none;
    if (fs::equivalent(folder / "scene.toml", scene.file, none))
        throw std::runtime_error(
            fmt::format("{}: holds the scene itself, which the run would write over; choose another "
                        "folder with -o",
                        folder.string()));
    if (force) return;
    if (!fs::exists(folder) || (fs::is_directory(folder) && fs::is_empty(folder))) return;
    if (fs::is_directory(folder) && !holds_run(folder))
        throw std::runtime_error(
            fmt::format("{}: holds other things than a run; choose another folder with -o, or let the "
                        "run add its files with --force",
                        folder.string()));
    if (!fs::is_directory(folder)) return;  // the writer says what is wrong
    const RunSummary run = fs::exists(folder / "run.json") ? read_summary(folder) : RunSummary{};
    const std::string other = run.scene_file.empty() ? "unknown" : run.scene_file;
    if (is_stream(scene.file) ? run.scene_hash == scene_hash(scene) : other == place(scene.file)) return;
    throw std::runtime_error(
        fmt::format("{}: holds the run of another scene, {}; choose another folder with -o, or "
                    "overwrite it with --force",
                    folder.string(), other));
}

std::vector<std::string> notes_on_plain_numbers(const std::string& text, const std::string& name,
                                                const Overrides& overrides) {
    std::vector<std::string> notes;
    for (const auto& [parameter, value] : overrides) {
        if (value == "0" || value.find_first_not_of("0123456789+-.eE") != std::string::npos) continue;
        try {
            const Scene own = parse_scene(text, name);
            const auto before = std::ranges::find(own.params, parameter, &Parameter::name);
            if (before != own.params.end() && !before->unit.empty())
                notes.push_back(fmt::format("{} = {} has no unit and is taken in SI; the scene says {}",
                                            parameter, value, before->text));
        } catch (const SceneErrors&) {  // it needs the override
        }
    }
    return notes;
}

RunSummary simulate(const Scene& scene, Built<2> built, const SimulateOptions& options) {
    Topology topology = topology_of(scene, built);
    SimulationIn<2> simulation(std::move(built.model), std::move(built.physics));
    StageTimes times = stages_of(simulation);
    StageTimes* const profile = options.profile ? &times : nullptr;
    simulation.profile(profile);
    const std::unique_ptr<RunMonitor> run_monitor = make_run_monitor(simulation);
    RunMonitor& monitor = *run_monitor;
    require_separable(scene, monitor);
    require_steps_that_end(scene, simulation);
    const double damping_rate = simulation.damping_rate();  // before separation ends it

    RunSummary summary = summary_at_start(scene, simulation, options);
    RunWriter writer(options.folder, to_comment(provenance_of(summary)), profile);
    writer.scene(write_scene(scene));
    writer.topology(std::move(topology));
    write_summary(options.folder, summary);
    summary.seconds["setup"] = seconds_since(options.begun);

    if (!options.quiet)
        fmt::print(stderr, "{}: {} particles, {} bonds, {} step {}\n", scene.title, summary.particles,
                   summary.bonds, scene.run.statics ? "load" : "time", format_si(summary.time_step, "s"));
    const auto solving = std::chrono::steady_clock::now();
    Recorder recorder(scene, simulation, monitor, writer, profile);
    summary.stopped = solve(scene, simulation, monitor, recorder, options.quiet, profile);
    recorder.finish();
    writer.drain();
    summary.seconds["solve"] = seconds_since(solving);
    if (profile) {
        times.add("setup", summary.seconds["setup"]);
        summary.profile["run"] = times.list();
    }
    add_results(summary, simulation, monitor);
    if (!summary.stopped)
        summary.warnings = run_warnings(scene, simulation, summary, damping_rate, recorder.largest_strain());
    summary.seconds["total"] = seconds_since(options.begun);
    writer.finish(summary);
    return summary;
}

}  // namespace hibi
