#include "pictures/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/chart.hpp"
#include "image/png.hpp"
#include "image/scales.hpp"
#include "image/sheet.hpp"
#include "pictures/key_frames.hpp"
#include "pictures/run_extents.hpp"
#include "record/files.hpp"
#include "record/provenance.hpp"
#include "report/curves.hpp"
#include "scene/read.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

/// A picture of a body that is narrower tells nothing any more.
constexpr double least_panel_mm = 40;

/// As many in a row as stay readable, and as even rows as that allows.
int columns_for(int panels, double width_mm) {
    const int most = std::clamp(static_cast<int>(width_mm / least_panel_mm), 1, std::max(panels, 1));
    const int rows = (panels + most - 1) / most;
    return (panels + rows - 1) / rows;
}

Image strip_image(const Scene& scene, const RunReader& run, const FigureStyle& style, int columns,
                  const RendererOptions& renderer) {
    const std::vector<KeyMoment> moments = key_moments(scene, run);
    const int count = static_cast<int>(moments.size());
    if (columns <= 0) columns = columns_for(count, style.width_mm);
    StillDrawing drawing(scene, run, style.theme, panel_width(columns, style), style.text(), renderer);
    std::vector<Panel> panels;
    for (const KeyMoment& m : moments) panels.push_back({drawing.draw(m.time), m.label, m.detail});
    return make_sheet(panels, "", columns, style);
}

/// All figures of a run in one style, as NAME + suffix. Returns the files written.
std::vector<fs::path> write_figures(const Scene& scene, const RunReader& run, const FigureStyle& style,
                                    const fs::path& folder, const std::string& suffix,
                                    const RendererOptions& renderer,
                                    const std::vector<std::string>& command = {}) {
    const Provenance provenance = followed_by(provenance_of(run.summary()), command);
    const PngOptions png{.text = to_texts(provenance), .small = true, .dpi = style.dpi};
    std::vector<fs::path> files;
    const auto write = [&](const char* name, const Image& image) {
        files.push_back(folder / (name + suffix + ".png"));
        write_png(files.back(), image, png);
    };
    write("strip", strip_image(scene, run, style, 0, renderer));
    write("cracks", cracks_image(scene, run, style, renderer));
    const std::vector<Chart> charts = run_charts(run.history(), run.summary().events);
    if (charts.empty()) return files;
    write("curve", chart_image(charts, style));
    files.push_back(folder / ("curve" + suffix + ".svg"));
    write_file(files.back(), chart_svg(charts, style, nullptr, to_comment(provenance)));
    return files;
}

std::string suffix_of(const FigureStyle& style) {
    return fmt::format("_{}_{:g}mm", style.theme, style.width_mm);
}

}  // namespace

Image cracks_image(const Scene& scene, const RunReader& run, const FigureStyle& style,
                   const RendererOptions& renderer) {
    HistoryDrawing drawing(scene, run, style.theme, style.width(), style.text(), renderer);
    FigureScales scales{.colours = drawing.colours(), .pixels_per_metre = drawing.pixels_per_metre()};
    if (!scales.colours) scales.note = std::string("No bond broke.");
    return with_scales(drawing.draw(), scales, style);
}

void draw_figures(const Scene& scene, const RunReader& run, const RendererOptions& renderer) {
    const fs::path& folder = run.folder();
    write_figures(scene, run, {.theme = scene.view.theme}, folder, "", renderer);
    fs::create_directories(folder / "figures");
    for (const double width : {85.0, 170.0}) {
        const FigureStyle style{.theme = "print", .width_mm = width};
        write_figures(scene, run, style, folder / "figures", suffix_of(style), renderer);
    }
}

std::vector<fs::path> draw_figures_again(const FiguresOptions& options) {
    const Scene scene = read_recorded_scene(options.folder);
    const RunReader run(options.folder);
    const fs::path output = options.output.value_or(options.folder / "figures");
    fs::create_directories(output);
    std::vector<fs::path> files;
    const std::vector<std::string> own{scene.view.theme};
    for (const std::string& theme : options.themes.empty() ? own : options.themes)
        for (const double width : options.widths) {
            const FigureStyle style{.theme = theme, .width_mm = width};
            const std::vector<std::string> command{"hibi",
                                                   "figures",
                                                   path_word(options.folder),
                                                   "--theme",
                                                   theme,
                                                   "--width",
                                                   fmt::format("{:g}", width),
                                                   "-o",
                                                   path_word(output)};
            for (const fs::path& file :
                 write_figures(scene, run, style, output, suffix_of(style), options.renderer, command))
                files.push_back(file);
        }
    return files;
}

fs::path draw_strip(const StripOptions& options) {
    const Scene scene = read_recorded_scene(options.folder);
    const RunReader run(options.folder);
    const FigureStyle style{.theme = options.theme.empty() ? scene.view.theme : options.theme,
                            .width_mm = options.width_mm};
    const fs::path file = options.output.value_or(options.folder / "strip.png");
    std::vector<std::string> command{"hibi",      "strip",   path_word(options.folder),          "--theme",
                                     style.theme, "--width", fmt::format("{:g}", style.width_mm)};
    if (options.columns > 0) command.insert(command.end(), {"--columns", std::to_string(options.columns)});
    command.insert(command.end(), {"-o", path_word(file)});
    write_png(file, strip_image(scene, run, style, options.columns, options.renderer),
              {.text = to_texts(followed_by(provenance_of(run.summary()), command)),
               .small = true,
               .dpi = style.dpi});
    return file;
}

}  // namespace hibi
