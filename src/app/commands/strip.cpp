#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "image/theme.hpp"
#include "pictures/figures.hpp"

namespace hibi {

void add_strip(CLI::App& app, int& status) {
    Command* strip = app.add_subcommand("strip", "Key frames of a recorded run in one picture");
    const auto o = options_of<StripOptions>();
    strip->add_option("DIR", o->folder, "folder of the run")->required();
    strip->add_option("-o,--output", o->output, "PNG to write (default: DIR/strip.png)");
    strip->add_option("--theme", o->theme, "dark, light or print (default: the scene's)")
        ->check(CLI::IsMember(theme_names()))
        ->type_name("TEXT");
    strip->add_option("--width", o->width_mm, "in mm, at 300 dpi")
        ->check(CLI::Range(20, 1000))
        ->capture_default_str();
    strip->add_option("--columns", o->columns, "pictures in a row (default: as many as stay readable)")
        ->check(CLI::Range(1, 100));
    add_drawing(*strip, o->renderer);
    strip->callback([o, &status] {
        fmt::print("{}\n", draw_strip(*o).string());
        status = 0;
    });
}

}  // namespace hibi
