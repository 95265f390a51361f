#include "pictures/figures.hpp"

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "image/theme.hpp"

namespace hibi {

void add_figures(CLI::App& app, int& status) {
    Command* figures =
        app.add_subcommand("figures", "Strip, crack history and curves of a recorded run, for print");
    const auto o = options_of<FiguresOptions>();
    figures->add_option("DIR", o->folder, "folder of the run")->required();
    figures->add_option("-o,--output", o->output, "folder to write to (default: DIR/figures)");
    figures
        ->add_option("--theme", o->themes, "dark, light, print, several with commas (default: the scene's)")
        ->check(CLI::IsMember(theme_names()))
        ->delimiter(',')
        ->type_name("TEXT");
    figures->add_option("--width", o->widths, "in mm, at 300 dpi, several with commas (default: 170)")
        ->check(CLI::Range(20, 1000))
        ->delimiter(',');
    add_drawing(*figures, o->renderer);
    figures->callback([o, &status] {
        for (const std::filesystem::path& file : draw_figures_again(*o)) fmt::print("{}\n", file.string());
        status = 0;
    });
}

}  // namespace hibi
