#include "studies/compare.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "base/progress.hpp"
#include "pictures/frame_writer.hpp"
#include "record/leftovers.hpp"
#include "record/provenance.hpp"
#include "studies/comparison.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

void require_folder(const CompareOptions& options) {
    const fs::path& folder = options.output;
    if (options.force || !fs::exists(folder) || fs::is_empty(folder)) return;
    if (fs::exists(folder / "compare.json")) return;
    throw std::runtime_error(
        fmt::format("{}: holds other things than a comparison; choose another folder with -o, or "
                    "add to it with --force",
                    folder.string()));
}

Provenance provenance_of(const CompareOptions& options, const std::string& title) {
    std::vector<std::string> words{"hibi", "compare"};
    for (const fs::path& folder : options.folders) words.push_back(path_word(folder));
    for (const std::string& label : options.labels) words.insert(words.end(), {"--label", label});
    if (!options.title.empty()) words.insert(words.end(), {"--title", options.title});
    if (options.align) words.insert(words.end(), {"--align", to_string(*options.align)});
    if (options.columns > 0) words.insert(words.end(), {"--columns", fmt::format("{}", options.columns)});
    if (options.size)
        words.insert(words.end(), {"--size", fmt::format("{}x{}", (*options.size)[0], (*options.size)[1])});
    words.insert(words.end(), {"-o", path_word(options.output)});
    return {title, HIBI_VERSION, "", "", shell_command(words)};
}

}  // namespace

void make_comparison(const CompareOptions& options) {
    std::vector<ComparedRun> runs = read_compared_runs(options);
    require_folder(options);
    fs::create_directories(options.output / "frames");
    remove_pictures(options.output);
    fs::create_directories(options.output / "frames");
    const MovieSpec movie = runs[0].scene.movie;
    const Provenance provenance =
        provenance_of(options, options.title.empty() ? runs[0].scene.title : options.title);
    Comparison comparison(options, std::move(runs));
    const Texts texts = to_texts(provenance);
    // It says of the folder that it is a comparison's, and is there from the beginning.
    write_texts(options.output / "compare.json", texts);

    const Video video{.width = comparison.width(),
                      .height = comparison.height(),
                      .fps = movie.fps,
                      .metadata = {{"title", provenance.title}, {"comment", to_comment(provenance)}},
                      .gif_limit = movie.gif_limit};
    FrameWriter writer(options.output, 2, options.formats.empty() ? movie.formats : options.formats, video);
    Progress progress("drawing", "frames", options.quiet);
    const int poster = comparison.poster();
    for (int k = 0; k < comparison.frames(); ++k) {
        Image image = writer.take();
        FrameInfo info{.file = fmt::format("frames/{:06}.png", k), .time = comparison.clock(k), .sha256 = {}};
        info.broken =
            comparison.draw(k, image, k + 1 < comparison.frames() ? std::optional(k + 1) : std::nullopt);
        for (const EventName name : comparison.plan(0).events[k]) info.events.push_back(to_string(name));
        if (const auto& event = comparison.plan(0).event[k]) info.event = to_string(*event);
        if (k == poster) write_png(options.output / "poster.png", image, {.text = texts, .small = true});
        writer.add(std::move(image), std::move(info), texts);
        progress.at(static_cast<double>(k + 1) / comparison.frames(), k + 1);
    }
    write_frames(options.output, writer.finish());
}

}  // namespace hibi
