#include "app/completion.hpp"

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"

namespace hibi {

void add_completion(CLI::App& app, int& status) {
    Command* completion = app.add_subcommand("completion", "Print the completion script of a shell");
    const auto shell = options_of<std::string>();
    completion->add_option("SHELL", *shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember(completion_shells()));
    completion->callback([shell, &app, &status] {
        fmt::print("{}", completion_script(app, *shell));
        status = 0;
    });
}

}  // namespace hibi
