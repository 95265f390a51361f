#include "studies/verify.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <stdexcept>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "image/png.hpp"
#include "measure/modal_displacement.hpp"
#include "record/files.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene/suggest.hpp"
#include "solve/run_to_end.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;
double since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

const std::string& built_in_scene(const std::string& name) {
    for (const auto& [scene, text] : built_in_scenes())
        if (scene == name) return text;
    throw std::logic_error("no built-in scene " + name);
}

/// Runs a scene to its end and observes so many moments of it. Adds particles, steps and time to the row.
VerifyRun observe(Scene scene, int observations, VerifyRow& row) {
    Built<2> built = build(scene);
    SimulationIn<2> simulation(std::move(built.model), std::move(built.physics));
    const std::unique_ptr<RunMonitor> monitor = make_run_monitor(simulation);
    const ModalDisplacement displacement(simulation);
    VerifyRun run{.scene = std::move(scene), .events = {}, .observations = {}};
    const auto look = [&] {
        run.observations.push_back({.row = monitor->row(),
                                    .modal_displacement = displacement.exists() ? displacement(simulation) : 0,
                                    .angular_momentum = angular_momentum(simulation)});
    };
    const double expected = run.scene.run.max_time / simulation.time_step();
    const auto stride = static_cast<std::int64_t>(std::ceil(expected / observations));
    const Clock::time_point begin = Clock::now();
    look();
    const auto obstacle = run_to_end(run.scene, simulation, *monitor, [&]() -> std::optional<std::string> {
        if (simulation.steps() % stride == 0) look();
        return {};
    });
    if (obstacle) throw std::runtime_error(*obstacle);
    // A body that collapses is no answer, even where something broke before.
    if (simulation.collapse()) throw std::runtime_error(*simulation.collapse());
    look();
    row.solve_seconds += since(begin);
    row.steps += simulation.steps();
    row.particles = simulation.particle_count();
    run.events = monitor->events();
    return run;
}

const char* name_of(Elasticity variant) { return variant == Elasticity::thesis ? "thesis" : "default"; }

std::vector<const VerifyCase*> chosen_cases(const std::vector<std::string>& ids) {
    std::vector<const VerifyCase*> chosen;
    std::vector<std::string> known;
    for (const VerifyCase& c : verify_cases()) {
        known.push_back(c.id);
        if (ids.empty() || std::ranges::find(ids, c.id) != ids.end()) chosen.push_back(&c);
    }
    for (const std::string& id : ids)
        if (std::ranges::find(known, id) == known.end()) {
            const auto near = nearest(id, known);
            throw std::invalid_argument(
                fmt::format("no case \"{}\"; {}", id,
                            near ? fmt::format("did you mean \"{}\"?", *near) : "known: " + list_of(known)));
        }
    return chosen;
}

std::string command_of(const VerifyOptions& options) {
    std::vector<std::string> words{"hibi", "verify"};
    for (const std::string& id : options.cases) words.insert(words.end(), {"--case", id});
    if (!options.variant.empty()) words.insert(words.end(), {"--variant", options.variant});
    if (options.quick) words.push_back("--quick");
    if (options.goals != 1) words.insert(words.end(), {"--goals", fmt::format("{}", options.goals)});
    words.insert(words.end(), {"-o", path_word(options.folder)});
    return shell_command(words);
}

void write_files(const std::vector<VerifyRow>& rows, const VerifyOptions& options, double seconds) {
    fs::create_directories(options.folder);
    const Provenance provenance{"Verification", HIBI_VERSION, "", "", command_of(options)};
    write_file(options.folder / "verify.json", verification_json(rows));
    write_file(options.folder / "verify.csv", verification_csv(rows, to_comment(provenance)));
    write_file(options.folder / "verify.html",
               verification_page(rows, {threads(), seconds, options.quick}, provenance));
    const std::vector<Chart> charts = speed_charts(rows);
    if (charts.empty()) return;
    const FigureStyle style{.theme = "light"};
    write_file(options.folder / "speed_vs_error.svg",
               chart_svg(charts, style, nullptr, to_comment(provenance)));
    write_png(options.folder / "speed_vs_error.png", chart_image(charts, style),
              {.text = to_texts(provenance), .small = true, .dpi = style.dpi});
}

}  // namespace

VerifyRow verify_row(const VerifyCase& c, const VerifyResolution& resolution, Elasticity variant) {
    const bool thesis = variant == Elasticity::thesis;
    VerifyRow row{.id = c.id,
                  .title = c.title,
                  .group = c.group,
                  .variant = name_of(variant),
                  .scene = c.scene,
                  .parameter = c.parameter,
                  .resolution = resolution.value,
                  .quantity = c.quantity,
                  .unit = c.unit,
                  .reference_text = c.reference};
    if (!thesis) row.goal = resolution.goal;
    const Clock::time_point begin = Clock::now();
    const std::clock_t cpu = std::clock();
    try {
        std::vector<VerifyRun> runs;
        for (Overrides overrides : c.overrides) {
            overrides.emplace_back(c.parameter, fmt::format("{}", resolution.value));
            Scene scene = parse_scene(built_in_scene(c.scene), c.scene + ".toml", overrides);
            scene.elasticity = variant;
            if (thesis && scene.run.statics) {  // which are for the default alone: come to rest in time
                scene.run.statics.reset();
                scene.damping = DampingSpec{.damping = {.rate = {}, .ratio = 1}, .until = {}};
            }
            row.method = scene.run.statics ? "static" : "explicit";
            runs.push_back(observe(std::move(scene), c.observations, row));
        }
        // The error shrinks with the time step where that is what is refined.
        row.spacing = c.parameter == "factor" ? resolution.value : runs[0].parameter("spacing");
        const VerifyResult result = c.judge(runs);
        row.measured = result.measured;
        row.reference = result.reference;
        row.error = result.error;
        if (!std::isfinite(result.error)) row.failure = "the run gave no result";
    } catch (const std::runtime_error& error) {
        row.failure = error.what();
    }
    row.seconds = since(begin);
    row.cpu_seconds = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
    return row;
}

Verification run_verification(const VerifyOptions& options) {
    const Clock::time_point begin = Clock::now();
    const std::vector<const VerifyCase*> cases = chosen_cases(options.cases);
    struct Task {
        const VerifyCase* the_case;
        VerifyResolution resolution;
        Elasticity variant;
    };
    std::vector<Task> tasks;
    for (const VerifyCase* c : cases)
        for (const Elasticity variant : {Elasticity::moment_matched, Elasticity::thesis}) {
            if (!options.variant.empty() && options.variant != name_of(variant)) continue;
            for (VerifyResolution r : c->resolutions) {
                if ((options.quick && !r.quick) || (variant == Elasticity::thesis && !r.thesis)) continue;
                if (r.goal) *r.goal *= options.goals;
                tasks.push_back({c, r, variant});
            }
        }
    // One after the other, each with all threads: the times are those of `hibi run`.
    std::vector<VerifyRow> rows;
    {
        Progress progress("verifying", "runs", options.quiet);
        for (const Task& task : tasks) {
            rows.push_back(verify_row(*task.the_case, task.resolution, task.variant));
            progress.at(static_cast<double>(rows.size()) / static_cast<double>(tasks.size()),
                        static_cast<double>(rows.size()), task.the_case->title);
        }
    }
    const double seconds = since(begin);
    write_files(rows, options, seconds);
    return {rows, seconds};
}

bool Verification::passes() const {
    return std::ranges::all_of(
        rows, [](const VerifyRow& row) { return row.failure.empty() && row.pass().value_or(true); });
}

}  // namespace hibi
