#include "app/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <stdexcept>

#include "app/command_text.hpp"

namespace hibi {

namespace {

/// Every name of all options.
std::vector<std::string> names_of(const std::vector<ArgumentText>& options) {
    std::vector<std::string> names;
    for (const ArgumentText& option : options)
        names.insert(names.end(), option.names.begin(), option.names.end());
    return names;
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != text.npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}
/// Between single quotes for bash and zsh, or for fish.
std::string quoted(const std::string& text) { return "'" + replaced(text, "'", "'\\''") + "'"; }
std::string fish_quoted(const std::string& text) {
    return "'" + replaced(replaced(text, "\\", "\\\\"), "'", "\\'") + "'";
}

/// Files are left to bash itself, which completes them where the function finds nothing.
std::string bash_case(const CommandText& command) {
    std::string cases;
    for (const ArgumentText& option : command.options) {
        if (option.value.empty() || option.takes_file()) continue;
        std::vector<std::string> patterns;
        for (const std::string& name : option.names) patterns.push_back(quoted(command.name + " " + name));
        cases += fmt::format(
            "        {}) {} ;;\n", fmt::join(patterns, " | "),
            option.choices.empty()
                ? "files=no"
                : fmt::format("words={}", quoted(fmt::format("{}", fmt::join(option.choices, " ")))));
    }
    std::vector<std::string> files;
    for (const ArgumentText& option : command.options)
        if (option.takes_file())
            for (const std::string& name : option.names) files.push_back(quoted(command.name + " " + name));
    if (!files.empty()) cases += fmt::format("        {}) ;;\n", fmt::join(files, " | "));
    std::vector<std::string> choices;
    for (const ArgumentText& argument : command.arguments)
        choices.insert(choices.end(), argument.choices.begin(), argument.choices.end());
    return cases + fmt::format("        {}*) options={}; words={}{} ;;\n", quoted(command.name + " "),
                               quoted(fmt::format("{}", fmt::join(names_of(command.options), " "))),
                               quoted(fmt::format("{}", fmt::join(choices, " "))),
                               command.arguments.empty() || !choices.empty() ? "; files=no" : "");
}

std::string bash_script(const CommandText& program, const std::vector<CommandText>& commands) {
    std::vector<std::string> words;
    std::string cases;
    for (const CommandText& command : commands) {
        words.push_back(command.name);
        cases += bash_case(command);
    }
    return fmt::format(R"(_{0}() {{
    local word="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD - 1]}}" command='' k
    local options='' words='' files=yes
    # --option=value arrives as three words.
    if [ "$word" = = ]; then word=''; elif [ "$before" = = ]; then before="${{COMP_WORDS[COMP_CWORD - 2]}}"; fi
    for ((k = 1; k < COMP_CWORD; ++k)); do
        if [ "${{COMP_WORDS[k]#-}}" = "${{COMP_WORDS[k]}}" ]; then command="${{COMP_WORDS[k]}}"; break; fi
    done
    case "$command $before" in
{3}        *) options={1}; words={2}; files=no ;;
    esac
    if [ "${{word#-}}" != "$word" ]; then words="$options"; fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
    if [ $files = no ]; then compopt +o default 2>/dev/null; fi
}}
complete -o default -F _{0} {0}
)",
                       program.name, quoted(fmt::format("{}", fmt::join(names_of(program.options), " "))),
                       quoted(fmt::format("{}", fmt::join(words, " "))), cases);
}

/// What follows an option or stands as an argument: ":NAME:what completes it".
std::string zsh_value(const ArgumentText& argument, const std::string& name) {
    if (!argument.choices.empty()) return fmt::format(":{}:({})", name, fmt::join(argument.choices, " "));
    return fmt::format(":{}:{}", name, argument.takes_file() ? "_files" : " ");
}

std::string zsh_arguments(const CommandText& command, const std::string& indent) {
    std::string lines;
    for (const ArgumentText& option : command.options) {
        const std::string help = replaced(replaced(option.help, "\\", "\\\\"), "]", "\\]");
        for (const std::string& name : option.names)
            lines += fmt::format(
                " \\\n{}{}", indent,
                quoted(fmt::format("*{}{}[{}]{}", name,
                                   name.starts_with("--") && !option.value.empty() ? "=" : "", help,
                                   option.value.empty() ? "" : zsh_value(option, option.value))));
    }
    for (const ArgumentText& argument : command.arguments)
        lines += fmt::format(
            " \\\n{}{}", indent,
            quoted((argument.required ? ":" : "::") + zsh_value(argument, argument.names[0]).substr(1)));
    return lines;
}

std::string zsh_script(const CommandText& program, const std::vector<CommandText>& commands) {
    std::string list, cases;
    for (const CommandText& command : commands) {
        list += fmt::format("        {}\n", quoted(command.name + ":" + replaced(command.help, ":", "\\:")));
        cases += fmt::format("        {}) _arguments{} ;;\n", command.name,
                             zsh_arguments(command, "            "));
    }
    return fmt::format(R"(#compdef {0}
_{0}() {{
    local curcontext="$curcontext" state line
    local -a commands=(
{1}    )
    _arguments -C{2} \
        '1:command:->command' '*::argument:->argument'
    case $state in
    command) _describe command commands ;;
    argument)
        case $words[1] in
{3}        esac ;;
    esac
}}
if [ "$funcstack[1]" = _{0} ]; then _{0} "$@"; else compdef _{0} {0}; fi
)",
                       program.name, list, zsh_arguments(program, "        "), cases);
}

std::string fish_line(const std::string& program, const std::string& when, const ArgumentText& option) {
    std::string line = fmt::format("complete -c {} -n {}", program, fish_quoted(when));
    for (const std::string& name : option.names)
        if (name.starts_with("-"))
            line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
    if (!option.choices.empty())
        line += " -x -a " + fish_quoted(fmt::format("{}", fmt::join(option.choices, " ")));
    else if (!option.value.empty())
        line += option.takes_file() ? " -r -F" : " -x";
    return line + " -d " + fish_quoted(option.help) + "\n";
}

std::string fish_script(const CommandText& program, const std::vector<CommandText>& commands) {
    const std::string no_command = "__fish_use_subcommand";
    std::string text = fmt::format("complete -c {} -f\n", program.name);
    for (const ArgumentText& option : program.options) text += fish_line(program.name, no_command, option);
    for (const CommandText& command : commands) {
        text += fmt::format("complete -c {} -n {} -a {} -d {}\n", program.name, no_command, command.name,
                            fish_quoted(command.help));
        const std::string when = "__fish_seen_subcommand_from " + command.name;
        for (const ArgumentText& option : command.options) text += fish_line(program.name, when, option);
        for (const ArgumentText& argument : command.arguments) {
            ArgumentText its = argument;
            its.names.clear();
            if (its.takes_file())
                text += fmt::format("complete -c {} -n {} -F\n", program.name, fish_quoted(when));
            else
                text += fish_line(program.name, when, its);
        }
    }
    return text;
}

}  // namespace

const std::vector<std::string>& completion_shells() {
    static const std::vector<std::string> shells{"bash", "zsh", "fish"};
    return shells;
}

std::string completion_script(const CLI::App& app, const std::string& shell) {
    const CommandText program = describe(app);
    const std::vector<CommandText> commands = describe_commands(app);
    if (shell == "bash") return bash_script(program, commands);
    if (shell == "zsh") return zsh_script(program, commands);
    if (shell == "fish") return fish_script(program, commands);
    throw std::out_of_range("no completion for the shell " + shell);
}

}  // namespace hibi
