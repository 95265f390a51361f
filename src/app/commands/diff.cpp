#include "picture_tests/diff.hpp"

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "picture_tests/findings.hpp"

namespace hibi {

void add_diff(CLI::App& app, int& status) {
    Command* command = app.add_subcommand(
        "diff", "Compare two pictures, films or runs: has the drawing changed, or the physics?");
    const auto o = options_of<DiffOptions>();
    const auto json = options_of<bool>();
    command
        ->add_option("EXPECTED", o->expected,
                     "picture or film, folder of them, frames.json, or folder of a run")
        ->required();
    command->add_option("ACTUAL", o->actual, "another of the same kind")->required();
    command->add_option("-o,--output", o->output, "folder of the pictures and the page")
        ->capture_default_str();
    command->add_flag("--json", *json, "print JSON instead of the verdict");
    command->add_option("--junit", o->junit, "write JUnit XML to this file");
    const auto limits = options_of<TestLimits>();
    add_tolerance(*command, *limits);
    command->callback([o, json, limits, &status] {
        set_limits(*limits, o->pixels, o->run);
        const Findings findings = diff(*o);
        if (*json)
            fmt::print("{}", findings_json(findings, *o));
        else
            fmt::print("{}\n{}\n", findings.line(), (o->output / "difference.html").string());
        status = findings.all() == Sameness::different ? 3 : 0;
    });
}

}  // namespace hibi
