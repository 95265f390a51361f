#include "studies/converge.hpp"

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"

namespace hibi {

void add_converge(CLI::App& app, int& status) {
    Command* converge =
        app.add_subcommand("converge", "The same experiment at several resolutions: table, plot, film");
    const auto o = options_of<ConvergeOptions>();
    const auto json = options_of<bool>();
    converge->add_option("SCENE", o->scene, "scene file (TOML)")->required()->transform(scene_word);
    add_study(*converge, o->grid, o->study, "folder of the runs (default: out/<scene name>_converge)");
    converge->add_flag_callback(
        "--one", [o] { o->both = false; }, "only with the scene's own criterion of failure, not with both");
    converge->add_flag_callback(
        "--no-movie", [o] { o->film = false; }, "no film side by side");
    converge->add_flag("--json", *json, "print converge.json instead of the table");
    add_drawing(*converge, o->renderer);
    converge->callback([o, json, &status] {
        const ConvergeResult result = run_convergence(*o);
        if (*json)
            fmt::print("{}", result.json);
        else
            fmt::print("{}{}{}\n", study_table(result.runs), result.verdict.warns ? "warning: " : "",
                       result.verdict.caption);
        status = study_status(result.runs);
    });
}

}  // namespace hibi
