#include "app/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "app/commands.hpp"

namespace hibi {

namespace {

constexpr const char* examples = R"(
Examples:
  hibi run scenes/bending_fine.toml            simulate, draw, encode: out/bending_fine/movie.mp4
  hibi run scene.toml -p spacing=0.5m -o out/fine
  hibi check scene.toml                        what would be modelled, and how long it would take
  hibi preview scene.toml -o setup.png         supports, loads and notches in one picture
  hibi render out/bending_fine                 draw again from the recorded states
  hibi diff out/before out/after               which bond broke first at another time
  hibi test scenes/                            compare with the references beside the scenes
  hibi reproduce figure.png                    the command that made it
  hibi verify --quick                          how accurate it is, and how fast
  hibi new my_scene.toml                       a commented scene to start from

Exit status: 0 done, 1 it failed, 2 the input is wrong, 3 pictures or runs differ,
4 done, but the energy balance is off by more than 2 %.
)";

}  // namespace

std::shared_ptr<CLI::App> make_command_line(int& status) {
    auto app = std::make_shared<CLI::App>("hibi turns one text file into a fracture film.", "hibi");
    app->footer(examples);
    app->require_subcommand(1);
    app->set_version_flag("--version", "hibi " HIBI_VERSION);
    app->set_help_all_flag("--help-all", "Help of every command");
#define HIBI_ADD(NAME) add_##NAME(*app, status);
    HIBI_COMMANDS(HIBI_ADD)
#undef HIBI_ADD
    for (CLI::App* command : app->get_subcommands({}))
        command->footer("");  // the examples stand in hibi --help
    return app;
}

int run_command_line(int argc, char** argv) {
    int status = 2;
    const std::shared_ptr<CLI::App> app = make_command_line(status);
    std::vector<std::string> words;
    for (const CLI::App* command : app->get_subcommands({})) words.push_back(command->get_name());
    if (argc > 1 && argv[1][0] != '-' && std::ranges::find(words, argv[1]) == words.end()) {
        fmt::print(stderr, "hibi: error: unknown command \"{}\"; known: {}\n", argv[1],
                   fmt::join(words, ", "));
        return 2;
    }
    try {
        app->parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app->exit(error) == 0 ? 0 : 2;
    }
    return status;
}

}  // namespace hibi
