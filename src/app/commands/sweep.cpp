#include "studies/sweep.hpp"

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"

namespace hibi {

namespace {

void print_table(const SweepResult& result) {
    fmt::print("{}", study_table(result.runs));
    const auto made = [&](const char* what, const char* file) {
        fmt::print("{:<16} {}\n", what, (result.folder / file).string());
    };
    made("table", "sweep.csv");
    if (result.plotted) made("plot", "plot.png");
    made("sheet", "sheet.png");
}

}  // namespace

void add_sweep(CLI::App& app, int& status) {
    Command* sweep =
        app.add_subcommand("sweep", "Run a scene for all combinations of parameters: table, sheet, plot");
    const auto o = options_of<SweepOptions>();
    const auto json = options_of<bool>();
    sweep->add_option("SCENE", o->scene, "scene file (TOML)")->required()->transform(scene_word);
    add_study(*sweep, o->grid, o->study, "folder of the runs (default: out/<scene name>_sweep)");
    sweep->add_flag("--pictures", o->study.pictures, "film, figures and report of every run, too");
    sweep->add_flag("--json", *json, "print sweep.json instead of the table");
    add_drawing(*sweep, o->renderer);
    sweep->callback([o, json, &status] {
        const SweepResult result = run_sweep(*o);
        if (!result.plotted && !o->study.quiet)
            fmt::print(stderr,
                       "no plot: it needs one or two parameters that vary, and two runs that succeed\n");
        if (*json)
            fmt::print("{}", result.json);
        else
            print_table(result);
        status = study_status(result.runs);
    });
}

}  // namespace hibi
