#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/run_results.hpp"
#include "app/shared_options.hpp"
#include "pictures/make_pictures.hpp"
#include "record/files.hpp"
#include "record/provenance.hpp"
#include "record/summary.hpp"
#include "scene/scene_file.hpp"
#include "solve/simulate.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

struct RunOptions {
    fs::path scene;
    std::optional<fs::path> folder{};  ///< absent: out/<scene name>
    Overrides overrides{};
    bool pictures = true;  ///< draw at all
    bool force = false;    ///< overwrite the run of another scene
    bool quiet = false;    ///< no progress
    bool json = false;     ///< print run.json instead of the table
    bool profile = false;  ///< measure how long each stage takes
    DrawOptions draw{};
};

/// The command that gives this run again. What does not change a result is left out. What came through a pipe
/// is gone, but the folder of the run keeps the scene, with the overrides in it.
std::string command_of(const RunOptions& options, const fs::path& folder) {
    if (is_stream(options.scene))
        return shell_command({"cat", path_word(folder / "scene.toml")}) + " | " +
               shell_command({"hibi", "run", "/dev/stdin", "-o", path_word(folder)});
    std::vector<std::string> words{"hibi", "run", path_word(options.scene)};
    for (const std::string& word : words_of(options.overrides)) words.push_back(word);
    words.insert(words.end(), {"-o", path_word(folder)});
    return shell_command(words);
}

using Clock = std::chrono::steady_clock;

/// Draws the run, and notes that in its summary. `begun` is when the command was.
void draw_recorded(const Scene& scene, const fs::path& folder, const RunOptions& options,
                   Clock::time_point begun, RunSummary& summary) {
    DrawOptions draw = options.draw;
    StageTimes times = drawing_stages();
    if (options.profile) draw.renderer.profile = &times;
    make_pictures(scene, folder, draw, options.quiet, summary);
    summary.seconds["total"] = std::chrono::duration<double>(Clock::now() - begun).count();
    write_summary(folder, summary);
}

/// Simulates, records, draws, encodes and reports. Returns the exit status: 0 done, 1 the run blew up, 4 its
/// energy balance cannot be trusted.
int run(const RunOptions& options) {
    const Clock::time_point begun = Clock::now();
    const std::string text = read_scene_text(options.scene);
    auto [scene, built] = parse_and_build(text, options.scene.string(), options.overrides);
    const fs::path folder = options.folder.value_or(fs::path("out") / scene_name(options.scene));
    refuse_other_scene(folder, scene, options.force);
    for (const std::string& note : notes_on_plain_numbers(text, options.scene.string(), options.overrides))
        fmt::print(stderr, "{}: note: {}\n", options.scene.string(), note);
    RunSummary summary = simulate(scene, std::move(built),
                                  {.folder = folder,
                                   .overrides = options.overrides,
                                   .command = command_of(options, folder),
                                   .quiet = options.quiet,
                                   .profile = options.profile,
                                   .begun = begun});
    if (summary.stopped) {
        fmt::print(stderr,
                   "{}: error: {}\nEverything recorded until then is in {}; draw it with: hibi render {}\n",
                   options.scene.string(), *summary.stopped, folder.string(), folder.string());
        return 1;
    }
    if (options.pictures) draw_recorded(scene, folder, options, begun, summary);
    for (const std::string& warning : summary.warnings)
        fmt::print(stderr, "{}: warning: {}\n", options.scene.string(), warning);
    if (options.json) {
        fmt::print("{}", read_file(folder / "run.json"));
    } else {
        const fs::path made = options.pictures ? main_picture(folder, options.draw) : folder / "states";
        fmt::print("{}", results_text(summary, made.string(), options.pictures));
        if (options.profile) fmt::print("{}", profile_text(summary, options.pictures));
    }
    return summary.trusted ? 0 : 4;
}

}  // namespace

void add_run(CLI::App& app, int& status) {
    Command* command = app.add_subcommand("run", "Simulate a scene, draw it and encode the film");
    const auto o = options_of<RunOptions>();
    add_scene(*command, o->scene, o->overrides);
    command->add_option("-o,--output", o->folder, "folder of the run (default: out/<scene name>)");
    add_movie(*command, o->draw);
    command->add_flag_callback(
        "--no-pictures", [o] { o->pictures = false; }, "simulate and record only");
    command->add_flag("--force", o->force, "overwrite the folder of another scene's run");
    command->add_flag("--json", o->json, "print run.json instead of the table");
    add_drawing(*command, o->draw.renderer);
    add_threads(*command);
    add_profile(*command, o->profile);
    add_quiet(*command, o->quiet);
    command->callback([o, &status] { status = run(*o); });
}

}  // namespace hibi
