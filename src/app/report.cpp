#include "app/report.hpp"

#include <fmt/format.h>

#include "app/key_frames.hpp"
#include "image/png.hpp"
#include "record/files.hpp"
#include "report/caption.hpp"
#include "report/page.hpp"
#include "scene/read.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

// Pictures of the page, for screens with two pixels per point (pixels).
constexpr int key_frame_width = 560;
constexpr double key_frame_text = 22;

std::string read_if_there(const fs::path& file) { return fs::exists(file) ? read_file(file) : ""; }

std::string png_bytes(const Image& image) {
    const std::vector<unsigned char> bytes = encode_png(image, {.small = true});
    return {bytes.begin(), bytes.end()};
}

}  // namespace

void write_report(const Scene& scene, const fs::path& folder, const RendererOptions& renderer) {
    const RunReader run(folder);
    const std::string description = describe(scene, run.topology());
    const Caption caption = caption_of(run.summary(), run.topology(), scene.about, description);
    PageContent page{.summary = run.summary(),
                     .about = scene.about,
                     .description = description,
                     .history = run.history(),
                     .scene = read_if_there(folder / "scene.toml"),
                     .caption = caption.alternative,
                     .poster = read_if_there(folder / "poster.png"),
                     .cracks = {},
                     .film = read_if_there(folder / "movie.mp4"),
                     .frame_times = {},
                     .fps = scene.movie.fps,
                     .key_frames = {}};
    if (!page.film.empty()) page.frame_times = film_style(scene, run).plan.time;
    StillDrawing stills(scene, run, scene.view.theme, key_frame_width, key_frame_text, renderer);
    for (const KeyMoment& m : key_moments(scene, run))
        page.key_frames.push_back({m.time, m.label, m.detail, png_bytes(stills.draw(m.time))});
    if (run.summary().broken > 0) page.cracks = read_if_there(folder / "cracks.png");
    write_file(folder / "report.html", report_page(page));

    const std::string label = fs::absolute(folder).lexically_normal().filename().string();
    write_file(folder / "caption.md", caption_markdown(caption, scene.title));
    fs::create_directories(folder / "snippets");
    write_file(folder / "snippets/figure.tex", latex_snippet(caption, label));
    write_file(folder / "snippets/figure.qmd", quarto_snippet(caption, label));
    write_file(folder / "snippets/figure.md", markdown_snippet(caption));
}

int report_command(const ReportOptions& options) {
    write_report(read_scene(options.folder / "scene.toml"), options.folder, options.renderer);
    fmt::print("{}\n", (options.folder / "report.html").string());
    return 0;
}

}  // namespace hibi
