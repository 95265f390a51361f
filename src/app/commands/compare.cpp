#include "studies/compare.hpp"

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"

namespace hibi {

void add_compare(CLI::App& app, int& status) {
    Command* compare =
        app.add_subcommand("compare", "One film of several runs, on one clock and with one colour range");
    const auto o = options_of<CompareOptions>();
    compare->add_option("DIR", o->folders, "folders of the runs")->required();
    compare->add_option("-o,--output", o->output, "folder of the film")->capture_default_str();
    compare
        ->add_option_function<std::string>(
            "--align", [o](const std::string& name) { o->align = event_from(name); },
            "let all clocks agree at first_break, peak_load or separation")
        ->check(CLI::IsMember({"first_break", "peak_load", "separation"}))
        ->type_name("TEXT");
    compare->add_option("--label", o->labels, "name of a run, once for each (default: what tells them apart)")
        ->allow_extra_args(false);
    compare->add_option("--title", o->title, "of the film (default: that of the first run)");
    compare->add_option("--columns", o->columns, "panels in a row (default: so that the bodies are largest)")
        ->check(CLI::Range(1, 100));
    compare
        ->add_option_function<std::string>(
            "--size",
            [o](const std::string& text) {
                int width = 0, height = 0;
                char rest = 0;
                if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 64 ||
                    height < 64 || width % 2 || height % 2)
                    throw CLI::ValidationError("--size",
                                               "needs even numbers of pixels, for example 1920x1080");
                o->size = {width, height};
            },
            "WIDTHxHEIGHT (default: that of the first run's film)")
        ->type_name("TEXT");
    add_formats(*compare, o->formats);
    compare->add_flag("--force", o->force, "write into a folder that holds other things");
    add_drawing(*compare, o->renderer);
    add_quiet(*compare, o->quiet);
    compare->callback([o, &status] {
        make_comparison(*o);
        fmt::print("{}\n", (o->output / film_in(o->output)).string());
        status = 0;
    });
}

}  // namespace hibi
