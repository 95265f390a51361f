#include "app/command_text.hpp"

#include <CLI/CLI.hpp>

namespace hibi {

namespace {

ArgumentText describe(const CLI::Option& option) {
    ArgumentText text;
    for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
    if (text.names.empty()) text.names = {option.get_name(true)};
    text.help = option.get_description();
    text.required = option.get_required();
    if (option.get_items_expected_max() == 0) return text;
    // "TEXT:{osmesa,egl}", "INT:INT in [1 - 1024]"
    const std::string type = option.get_type_name();
    text.value = type.substr(0, type.find(':'));
    const std::size_t open = type.find(":{"), close = type.find('}', open);
    if (open == std::string::npos || close == std::string::npos) return text;
    std::stringstream list(type.substr(open + 2, close - open - 2));
    for (std::string choice; std::getline(list, choice, ',');) text.choices.push_back(choice);
    return text;
}

}  // namespace

CommandText describe(const CLI::App& command) {
    CommandText text{command.get_name(), command.get_description(), {}, {}};
    for (const CLI::Option* option : command.get_options())
        (option->nonpositional() ? text.options : text.arguments).push_back(describe(*option));
    return text;
}

std::vector<CommandText> describe_commands(const CLI::App& app) {
    std::vector<CommandText> commands;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
        commands.push_back(describe(*command));
        // Every command inherits the help of all commands.
        std::erase_if(commands.back().options,
                      [](const ArgumentText& o) { return o.names[0] == "--help-all"; });
    }
    return commands;
}

}  // namespace hibi
