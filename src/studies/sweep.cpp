#include "studies/sweep.hpp"

#include <fmt/format.h>

#include "image/png.hpp"
#include "record/files.hpp"
#include "record/provenance.hpp"
#include "scene/scene_file.hpp"

namespace hibi {

namespace fs = std::filesystem;

SweepResult run_sweep(SweepOptions options) {
    require_file(options.scene);
    const Grid grid = read_grid(options.grid);
    if (options.study.folder.empty())
        options.study.folder = fs::path("out") / (options.scene.stem().string() + "_sweep");
    const fs::path& folder = options.study.folder;
    require_study_folder(folder, options.study.force);
    const std::vector<StudyRun> runs =
        run_study(distinct_points(grid_points(options.scene, grid)), options.study);

    std::vector<std::string> words{"hibi", "sweep", path_word(options.scene)};
    for (const std::string& text : options.grid) words.insert(words.end(), {"-p", text});
    words.insert(words.end(), {"-o", path_word(folder)});
    std::string title = options.scene.stem().string();
    for (const StudyRun& run : runs)
        if (run.done()) title = run.summary->title;
    const Provenance provenance{title, HIBI_VERSION, "", "", shell_command(words)};

    fs::create_directories(folder);
    const std::string json = study_json(runs, title, provenance.command);
    write_file(folder / "sweep.csv", study_csv(runs, to_comment(provenance)));
    write_file(folder / "sweep.json", json);
    write_sheet(runs, folder, title, options.renderer, provenance);
    const std::optional<Chart> chart = study_chart(runs);
    if (chart) {
        const FigureStyle style{.theme = "light"};
        write_png(folder / "plot.png", chart_image({*chart}, style),
                  {.text = to_texts(provenance), .small = true, .dpi = style.dpi});
        write_file(folder / "plot.svg", chart_svg({*chart}, style, nullptr, to_comment(provenance)));
    }
    return {folder, runs, json, chart.has_value()};
}

}  // namespace hibi
