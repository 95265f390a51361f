#include "app/run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <numbers>
#include <thread>

#include "app/figures.hpp"
#include "app/profile.hpp"
#include "app/progress.hpp"
#include "app/quasi_static.hpp"
#include "app/recorder.hpp"
#include "app/report.hpp"
#include "base/parallel.hpp"
#include "base/units.hpp"
#include "measure/watch.hpp"
#include "record/leftovers.hpp"
#include "record/provenance.hpp"
#include "record/summary.hpp"
#include "report/place.hpp"
#include "scene/scene_file.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

/// Beyond this the balance is not merely off: the run makes energy from nothing.
constexpr double runaway_imbalance = 1;
constexpr double trusted_imbalance = 0.02;
/// Of bonds; the elastic law is linear.
constexpr double most_strain = 0.5;
/// A body of a few particles makes them in an hour.
constexpr double most_steps = 1e9;

class Stopwatch {
 public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    }

 private:
    std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// By which a run knows its scene again.
std::string place(const fs::path& scene) {
    return is_stream(scene) ? scene.string() : fs::weakly_canonical(scene).string();
}

/// A folder is used that holds nothing of a run's, or the run of the same scene. A scene from a pipe has no
/// file by which it could be known again: it is the same only where nothing in it has changed.
void refuse_other_scene(const fs::path& folder, const RunOptions& options, const Scene& scene) {
    std::error_code none;
    if (fs::equivalent(folder / "scene.toml", options.scene, none))
        throw std::runtime_error(
            fmt::format("{}: holds the scene itself, which the run would write over; choose another "
                        "folder with -o",
                        folder.string()));
    if (options.force) return;
    if (!fs::exists(folder) || (fs::is_directory(folder) && fs::is_empty(folder))) return;
    if (fs::is_directory(folder) && !holds_run(folder))
        throw std::runtime_error(
            fmt::format("{}: holds other things than a run; choose another folder with -o, or let the "
                        "run add its files with --force",
                        folder.string()));
    if (!fs::is_directory(folder)) return;  // the writer says what is wrong
    const RunSummary run = fs::exists(folder / "run.json") ? read_summary(folder) : RunSummary{};
    const std::string other = run.scene_file.empty() ? "unknown" : run.scene_file;
    if (is_stream(options.scene) ? run.scene_hash == scene_hash(scene) : other == place(options.scene))
        return;
    throw std::runtime_error(
        fmt::format("{}: holds the run of another scene, {}; choose another folder with -o, or "
                    "overwrite it with --force",
                    folder.string(), other));
}

/// A number that lost its unit on the command line is taken as SI, which may be far from what was meant.
void note_plain_numbers(const RunOptions& options, const std::string& scene_text) {
    for (const auto& [name, text] : options.overrides) {
        if (text == "0" || text.find_first_not_of("0123456789+-.eE") != std::string::npos) continue;
        try {
            const Scene own = parse_scene(scene_text, options.scene.string());
            const auto before =
                std::ranges::find_if(own.params, [&](const Parameter& p) { return p.name == name; });
            if (before != own.params.end() && !before->unit.empty())
                fmt::print(stderr, "{}: note: {} = {} has no unit and is taken in SI; the scene says {}\n",
                           options.scene.string(), name, text, before->text);
        } catch (const SceneErrors&) {  // it needs the override
        }
    }
}

/// The command that gives this run again. What does not change a result is left out. What came through a pipe
/// is gone, but the folder of the run keeps the scene, with the overrides in it.
std::string command_of(const RunOptions& options, const fs::path& folder) {
    if (is_stream(options.scene))
        return shell_command({"cat", path_word(folder / "scene.toml")}) + " | " +
               shell_command({"hibi", "run", "/dev/stdin", "-o", path_word(folder)});
    std::vector<std::string> words{"hibi", "run", path_word(options.scene)};
    for (const auto& [name, value] : options.overrides) words.insert(words.end(), {"-p", name + "=" + value});
    words.insert(words.end(), {"-o", path_word(folder)});
    return shell_command(words);
}

/// The particle that moves fastest: where a run goes wrong.
std::string fastest(const Simulation<2>& simulation) {
    const std::vector<Vec<2>>& v = simulation.model().particles.velocity;
    const auto most = std::max_element(v.begin(), v.end(), [](const Vec<2>& a, const Vec<2>& b) {
        return a.cwiseAbs().maxCoeff() < b.cwiseAbs().maxCoeff();
    });
    const auto i = most - v.begin();
    return fmt::format("fastest is particle {} (body \"{}\")", i,
                       simulation.model().bodies[simulation.model().particles.body[i]].name);
}

/// Moves the simulation to its end. Returns why it stopped early, if it did.
std::optional<std::string> solve(const Scene& scene, Simulation<2>& simulation, Watch<2>& watch,
                                 Recorder& recorder, bool quiet, StageTimes* profile) {
    Progress progress("solving", "steps", quiet);
    while (!reached_end(scene, watch, simulation.time())) {
        simulation.step();
        {
            const TimedStage timed(profile, "watch");
            watch.look();
        }
        if (simulation.failure()) return simulation.failure()->message;
        if (simulation.collapse()) {
            recorder.look();
            // After a break a collapse is how a fracture may end.
            return watch.events().first_break ? std::nullopt : simulation.collapse();
        }
        pull_triggers(scene, watch.events(), simulation);
        recorder.look();
        if (!std::isfinite(recorder.imbalance()) ||
            (watch.settled() && recorder.imbalance() > runaway_imbalance))
            return fmt::format(
                "step {}, t = {:.6g} s: the energy balance ran away (imbalance {:.0f} %), {}; {}",
                simulation.steps(), simulation.time(), 100 * recorder.imbalance(), fastest(simulation),
                simulation.likely_cause());
        if (simulation.steps() % 64 == 0 || scene.run.statics)
            progress.at(simulation.time() / scene.run.max_time, static_cast<double>(simulation.steps()),
                        fmt::format("t = {}, {} bonds broken", format_si(simulation.time(), "s"),
                                    simulation.broken()));
    }
    return {};
}

/// A linear law does not know that nothing stretches so far.
void warn_of_strain(double largest_strain, std::vector<std::string>& list) {
    if (largest_strain <= most_strain) return;
    list.push_back(fmt::format(
        "intact bonds were stretched or squeezed by as much as {:.3g} % of their length: more than a "
        "linear law can stand for; give the material a break_strain, or lower the load",
        100 * largest_strain));
}

/// Damped by a ratio, a run is meant to be slow: what its ramps do to the load at first break.
void warn_of_fast_ramps(const Scene& scene, const RunSummary& summary, double damping_rate,
                        std::vector<std::string>& list) {
    if (!scene.damping || !scene.damping->damping.ratio || !summary.events.first_break) return;
    const double ratio = *scene.damping->damping.ratio, period = 4 * std::numbers::pi * ratio / damping_rate;
    for (const LoadSpec& load : scene.loads) {
        if (load.kind == Load::Kind::velocity || load.ramp == 0) continue;
        const double rises = std::min(load.ramp, summary.events.first_break->time);
        const std::string text = fast_ramp(load.name, load.ramp, rises, period, ratio);
        if (!text.empty()) list.push_back(text);
    }
}

std::vector<std::string> warnings(const Scene& scene, const Simulation<2>& simulation,
                                  const RunSummary& summary, double damping_rate, double largest_strain) {
    std::vector<std::string> list;
    if (simulation.instability()) list.push_back(*simulation.instability());
    if (simulation.collapse()) list.push_back(*simulation.collapse());
    if (simulation.can_break() && !summary.events.first_break)
        list.push_back(
            fmt::format("nothing broke: in the end the most strained bond is at {:.2g} % of its "
                        "limit; raise the load, or max_time",
                        100 * simulation.closest_to_breaking()));
    const Events& events = summary.events;
    if (scene.run.until && scene.run.until->event && !summary.stopped) {
        const EventName event = *scene.run.until->event;
        const bool seen = (event == EventName::first_break && events.first_break) ||
                          (event == EventName::peak_load && summary.end_time < scene.run.max_time) ||
                          (event == EventName::separation && events.separation);
        if (!seen) {
            list.push_back(fmt::format("{} was not reached before max_time = {}", to_string(event),
                                       format_si(scene.run.max_time, "s")));
            if (event == EventName::separation && events.first_break) {
                list.back() +=
                    ": what is loaded still hangs together with what is held, by one bond at least; raise "
                    "the "
                    "load or max_time, or let [run] until be another moment";
                if (scene.damping && (!scene.damping->until || !scene.damping->until->event ||
                                      scene.damping->until->event == EventName::separation))
                    list.back() += "; damping holds back what falls: [damping] until = \"first_break\"";
            }
        }
    }
    if (!summary.trusted)
        list.push_back(
            fmt::format("the energy balance is off by {:.2g} %: do not trust this run; {} may help",
                        100 * summary.worst_imbalance,
                        scene.run.statics ? "more load_steps" : "a smaller time_step_factor"));
    warn_of_strain(largest_strain, list);
    warn_of_fast_ramps(scene, summary, damping_rate, list);
    return list;
}

/// Draws frames, films, figures and the report, and notes in the summary how many frames and how long.
void draw_with_progress(const Scene& scene, const fs::path& folder, DrawOptions options, bool quiet,
                        RunSummary& summary) {
    Progress progress("drawing", "frames", quiet);
    options.progress = [&](int done, int of) { progress.at(static_cast<double>(done) / of, done); };
    const DrawResult drawn = draw_run(scene, folder, options);
    summary.frames = drawn.frames;
    summary.fps = drawn.frames > 0 ? scene.movie.fps : 0;
    summary.seconds["draw"] = drawn.draw_seconds;
    summary.seconds["draw_processor"] = drawn.processor_seconds;
    summary.seconds["encode"] = drawn.encode_seconds;
    if (options.renderer.profile) summary.profile["draw"] = options.renderer.profile->list();
    options.renderer.profile = nullptr;  // what follows draws no frames
    if (!options.report) return;
    const Stopwatch figures;
    // The report reads there what is said of the film.
    if (fs::exists(folder / "run.json")) write_summary(folder, summary);
    const RunReader run(folder);
    draw_figures(scene, run, options.renderer);
    write_report(scene, run, options.renderer);
    summary.seconds["figures"] = figures.seconds();
}

/// What was measured of the run, and of the drawing where there was one.
void print_profile(const RunSummary& s, bool drawn) {
    std::string text;
    if (const auto run = s.profile.find("run"); run != s.profile.end())
        text += "\n" + profile_table("run", run->second, s.seconds.at("setup") + s.seconds.at("solve"));
    if (const auto draw = s.profile.find("draw"); drawn && draw != s.profile.end()) {
        const double wall = s.seconds.at("draw"), processor = s.seconds.at("draw_processor");
        text += "\n" + profile_table("draw", draw->second, wall);
        const double frames = std::max(1, s.frames);
        const unsigned cores = std::thread::hardware_concurrency();
        text += fmt::format(
            "{} frames of {:.1f} ms, {:.1f} ms of processor time each: {:.0f} % of {} cores\n", s.frames,
            1000 * wall / frames, 1000 * processor / frames, 100 * processor / (wall * cores), cores);
    }
    fmt::print("{}", text);
    std::fflush(stdout);
}

std::string event_line(const char* name, const std::optional<Event>& event, bool loaded, bool with_place) {
    if (!event) return fmt::format("{:<16} -\n", name);
    std::string line = fmt::format("{:<16} t = {:<10}", name, format_si(event->time, "s", 4));
    if (loaded)
        line += fmt::format(" load {:<10} displacement {}", format_si(event->load, "N", 4),
                            format_si(event->displacement, "m"));
    if (with_place) line += fmt::format("  at {}", place_text(event->position));
    return line + "\n";
}

/// What a user looks at first.
std::string made(const fs::path& folder, bool pictures, const DrawOptions& draw) {
    if (!pictures) return (folder / "states").string();
    if (!draw.movie) return (folder / "strip.png").string();
    const std::string film = film_in(folder);
    return (folder / (film.empty() ? "frames" : film)).string();
}

void print_results(const RunSummary& s, const fs::path& folder, const RunOptions& options) {
    std::string text;
    text += event_line("first break", s.events.first_break, s.events.peak_load.has_value(), true);
    text += event_line("peak load", s.events.peak_load, true, false);
    // As large as the scene made it, then; no strength of the body.
    if (s.events.peak_load && !s.events.separation && s.events.peak_load->time > s.end_time - 2 * s.time_step)
        text.insert(text.size() - 1, "  still rising at the end");
    text += event_line("separation", s.events.separation, true, false);
    text += fmt::format("{:<16} {} of {}, in {} steps of {}\n", "broken bonds", s.broken, s.bonds, s.steps,
                        format_si(s.time_step, "s"));
    if (s.crack.tip)
        text += fmt::format("{:<16} {} long, fastest {}; {} fragments, the largest {}, debris {}\n", "cracks",
                            format_si(s.crack.length, "m"), format_si(s.top_crack_speed, "m/s"),
                            s.fragments.count, format_si(1000 * s.fragments.largest, "g"),
                            format_si(1000 * s.fragments.debris, "g"));
    text += fmt::format("{:<16} {:.2g} up to first break, {:.2g} to the end: {}\n", "energy imbalance",
                        s.imbalance_at_first_break, s.worst_imbalance, s.trusted ? "trusted" : "NOT TRUSTED");
    text += fmt::format("{:<16} solve {:.2f}, draw {:.1f}, all {:.1f}\n", "seconds", s.seconds.at("solve"),
                        options.pictures ? s.seconds.at("draw") : 0.0, s.seconds.at("total"));
    text += fmt::format("{:<16} {}\n", options.pictures ? "pictures" : "states",
                        made(folder, options.pictures, options.draw));
    fmt::print("{}", text);
    std::fflush(stdout);
}

}  // namespace

void pull_triggers(const Scene& scene, const Events& events, Simulation<2>& simulation) {
    const auto reached = [&](const std::optional<Moment>& moment) {
        if (!moment) return false;
        const std::optional<double> time = events.time_of(*moment);
        return time && simulation.time() >= *time;
    };
    if (scene.damping && reached(scene.damping->until)) simulation.stop_damping();
    for (std::size_t l = 0; l < scene.loads.size(); ++l)
        if (reached(scene.loads[l].until)) simulation.release(static_cast<int>(l));
}

bool reached_end(const Scene& scene, const Watch<2>& watch, double time) {
    if (time >= scene.run.max_time) return true;
    if (!scene.run.until) return false;
    if (scene.run.until->event == EventName::peak_load && !watch.peak_confirmed()) return false;
    const std::optional<double> end = watch.events().time_of(*scene.run.until);
    return end && time >= *end;
}

void require_separable(const Scene& scene, const Watch<2>& watch) {
    const auto asks = [](const std::optional<Moment>& m) { return m && m->event == EventName::separation; };
    const bool asked = asks(scene.run.until) || (scene.damping && asks(scene.damping->until)) ||
                       std::any_of(scene.loads.begin(), scene.loads.end(),
                                   [&](const LoadSpec& load) { return asks(load.until); });
    if (!asked || watch.can_separate()) return;
    throw SceneErrors(
        scene.file.string(), "",
        {{.message =
              "separation cannot happen: no bonds lead from a held particle to one of the primary [[load]], "
              "even before the run (a particle that is both counts as loaded)"}});
}

void require_steps_that_end(const Scene& scene, const Simulation<2>& simulation) {
    const double steps = scene.run.max_time / simulation.time_step();
    if (steps <= most_steps) return;
    throw SceneErrors(
        scene.file.string(), "",
        {{.message = fmt::format(
              "[run] max_time: {} are {:.2g} steps of {}, which would not end; at most {:g}",
              format_si(scene.run.max_time, "s"), steps, format_si(simulation.time_step(), "s"), most_steps),
          .hint =
              "lower max_time or raise the spacing; are the units of youngs_modulus and density right?"}});
}

int run_command(const RunOptions& options) {
    const Stopwatch total;
    const std::string text = read_scene_text(options.scene);
    auto [scene, built] = parse_and_build(text, options.scene.string(), options.overrides);
    const fs::path folder = options.folder.value_or(fs::path("out") / scene_name(options.scene));
    refuse_other_scene(folder, options, scene);
    note_plain_numbers(options, text);
    Topology topology = topology_of(scene, built);
    Simulation<2> simulation(std::move(built.model), std::move(built.physics));
    std::vector<std::string> stages = simulation.stage_names();
    stages.insert(stages.begin(), "setup");
    stages.insert(stages.end(), {"watch", "take states", "history", "wait for the writer", "write states"});
    StageTimes times(stages);
    StageTimes* const profile = options.profile ? &times : nullptr;
    simulation.profile(profile);
    Watch<2> watch(simulation);
    require_separable(scene, watch);
    require_steps_that_end(scene, simulation);
    const double damping_rate = simulation.damping_rate();  // before separation ends it

    RunSummary summary;
    summary.title = scene.title;
    summary.parameters = {options.overrides.begin(), options.overrides.end()};
    summary.command = command_of(options, folder);
    summary.scene_hash = scene_hash(scene);
    summary.scene_file = place(options.scene);
    summary.version = HIBI_VERSION;
    summary.particles = simulation.model().particles.count();
    summary.bonds = simulation.model().bonds.count();
    summary.threads = threads();
    summary.time_step = simulation.time_step();
    summary.stopped = "it is still running, or was killed";
    summary.trusted = false;
    RunWriter writer(folder, to_comment(provenance_of(summary)), profile);
    writer.scene(write_scene(scene));
    writer.topology(std::move(topology));
    write_summary(folder, summary);
    summary.seconds["setup"] = total.seconds();

    if (!options.quiet)
        fmt::print(stderr, "{}: {} particles, {} bonds, {} step {}\n", scene.title, summary.particles,
                   summary.bonds, scene.run.statics ? "load" : "time", format_si(summary.time_step, "s"));
    const Stopwatch solving;
    Recorder recorder(scene, simulation, watch, writer, profile);
    summary.stopped = solve(scene, simulation, watch, recorder, options.quiet, profile);
    recorder.finish();
    writer.drain();
    summary.seconds["solve"] = solving.seconds();
    if (profile) {
        times.add("setup", summary.seconds["setup"]);
        summary.profile["run"] = times.list();
    }
    summary.broken = simulation.broken();
    summary.steps = simulation.steps();
    summary.end_time = simulation.time();
    summary.events = watch.events();
    summary.crack = watch.crack();
    summary.top_crack_speed = watch.top_crack_speed();
    summary.fragments = watch.fragments();
    summary.worst_imbalance = watch.worst_imbalance();
    summary.imbalance_at_first_break = watch.imbalance_before_first_break();
    summary.trusted = !summary.stopped && summary.worst_imbalance <= trusted_imbalance;
    if (!summary.stopped)
        summary.warnings = warnings(scene, simulation, summary, damping_rate, recorder.largest_strain());
    summary.seconds["total"] = total.seconds();
    writer.finish(summary);
    if (summary.stopped) {
        fmt::print(stderr,
                   "{}: error: {}\nEverything recorded until then is in {}; draw it with: hibi render {}\n",
                   options.scene.string(), *summary.stopped, folder.string(), folder.string());
        return 1;
    }

    if (options.pictures) {
        DrawOptions draw = options.draw;
        StageTimes draw_times = drawing_stages();
        if (profile) draw.renderer.profile = &draw_times;
        draw_with_progress(scene, folder, draw, options.quiet, summary);
        summary.seconds["total"] = total.seconds();
        write_summary(folder, summary);
    }
    for (const std::string& warning : summary.warnings)
        fmt::print(stderr, "{}: warning: {}\n", options.scene.string(), warning);
    if (options.json) {
        std::ifstream json(folder / "run.json");
        fmt::print("{}", std::string(std::istreambuf_iterator<char>(json), {}));
    } else {
        print_results(summary, folder, options);
        if (profile) print_profile(summary, options.pictures);
    }
    return summary.trusted ? 0 : 4;
}

int render_command(const RenderOptions& options) {
    const fs::path& folder = options.folder;
    const Scene scene = options.scene ? read_scene(*options.scene) : read_recorded_scene(folder);
    const bool summarised = fs::exists(folder / "run.json");  // a killed run may lack it
    RunSummary summary = summarised ? read_summary(folder) : RunSummary{};
    DrawOptions draw = options.draw;
    if (options.scene || !draw.formats.empty()) {
        draw.command = {"hibi", "render", path_word(folder)};
        if (options.scene) draw.command.insert(draw.command.end(), {"--scene", path_word(*options.scene)});
        if (!draw.formats.empty())
            draw.command.insert(draw.command.end(),
                                {"--formats", fmt::format("{}", fmt::join(draw.formats, ","))});
    }
    StageTimes times = drawing_stages();
    if (options.profile) draw.renderer.profile = &times;
    draw_with_progress(scene, folder, draw, options.quiet, summary);
    if (summarised) write_summary(folder, summary);
    fmt::print("{}\n", made(folder, true, options.draw));
    if (options.profile) {
        summary.profile.erase("run");
        print_profile(summary, true);
    }
    return 0;
}

}  // namespace hibi
