#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands.hpp"
#include "app/run_results.hpp"
#include "app/shared_options.hpp"
#include "pictures/make_pictures.hpp"
#include "record/provenance.hpp"
#include "record/summary.hpp"
#include "scene/read.hpp"

namespace hibi {

namespace {

struct RenderOptions {
    std::filesystem::path folder;
    std::optional<std::filesystem::path> scene{};  ///< of [view] and [movie]; absent: as recorded
    bool quiet = false;
    bool profile = false;  ///< measure how long each stage takes
    DrawOptions draw{};
};

/// Pictures and film of a recorded run once more.
int render(const RenderOptions& options) {
    const std::filesystem::path& folder = options.folder;
    const Scene scene = options.scene ? read_scene(*options.scene) : read_recorded_scene(folder);
    const bool summarised = std::filesystem::exists(folder / "run.json");  // a killed run may lack it
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
    make_pictures(scene, folder, draw, options.quiet, summary);
    if (summarised) write_summary(folder, summary);
    fmt::print("{}\n", main_picture(folder, options.draw).string());
    if (options.profile) {
        summary.profile.erase("run");
        fmt::print("{}", profile_text(summary, true));
    }
    return 0;
}

}  // namespace

void add_render(CLI::App& app, int& status) {
    Command* command = app.add_subcommand("render", "Draw a recorded run again, without simulating");
    const auto o = options_of<RenderOptions>();
    command->add_option("DIR", o->folder, "folder of the run")->required();
    command->add_option("--scene", o->scene,
                        "take [view] and [movie] from this scene instead of DIR/scene.toml");
    add_movie(*command, o->draw);
    add_drawing(*command, o->draw.renderer);
    add_threads(*command);
    add_profile(*command, o->profile);
    add_quiet(*command, o->quiet);
    command->callback([o, &status] { status = render(*o); });
}

}  // namespace hibi
