#include "app/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <sstream>

#include "app/command_text.hpp"

namespace hibi {

namespace {

/// Text as roff writes it: its own characters escaped, hyphens as they are typed.
std::string roff(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (out.empty() && (c == '.' || c == '\'')) out += "\\&";
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else
            out += c;
    }
    return out;
}

std::string bold(const std::string& text) { return "\\fB" + roff(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + roff(text) + "\\fR"; }

std::string option_entry(const ArgumentText& option) {
    std::vector<std::string> names;
    for (const std::string& name : option.names) names.push_back(bold(name));
    std::string value;
    if (!option.choices.empty())
        value = " " + italic(fmt::format("{}", fmt::join(option.choices, "|")));
    else if (!option.value.empty())
        value = " " + italic(option.value);
    return fmt::format(".TP\n{}{}\n{}\n", fmt::join(names, ", "), value, roff(option.help));
}

std::string command_entry(const std::string& program, const CommandText& command) {
    std::string line = bold(program + " " + command.name);
    for (const ArgumentText& argument : command.arguments)
        line += argument.required ? " " + italic(argument.names[0]) : " [" + italic(argument.names[0]) + "]";
    std::string text = fmt::format(".SS {}\n{}.\n", line, roff(command.help));
    for (const ArgumentText& argument : command.arguments)
        text += fmt::format(".TP\n{}\n{}\n", italic(argument.names[0]), roff(argument.help));
    for (const ArgumentText& option : command.options)
        if (option.names.back() != "--help") text += option_entry(option);
    return text;
}

/// The lines of the footer below "Examples:", as they stand.
std::string examples_of(const std::string& footer) {
    std::stringstream lines(footer);
    std::string text;
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("  ")) text += roff(line.substr(2)) + "\n";
    return text;
}

/// "Exit status: 0 done, 1 it failed, ..." of the footer, without its first two words.
std::string exit_status_of(const std::string& footer) {
    const std::string head = "Exit status: ";
    const std::size_t begin = footer.find(head);
    return begin == std::string::npos ? "" : footer.substr(begin + head.size());
}

constexpr const char* files = R"(.TP
\fIout/NAME/\fR
what a run of the scene NAME leaves: the film, frames, tables, recorded states, figures and a report
.TP
\fIPREFIX/share/hibi/scenes/\fR
the scenes that
.B hibi new \-\-list
shows
.TP
\fIPREFIX/share/hibi/scene.schema.json\fR
JSON Schema of the scene file, for completion in editors
.TP
\fIPREFIX/share/doc/hibi/REFERENCE.md\fR
every block and key of a scene
)";

}  // namespace

std::string manual_page(const CLI::App& app) {
    const CommandText program = describe(app);
    std::string page = fmt::format(".TH HIBI 1 \"\" \"hibi {}\" \"User Commands\"\n", HIBI_VERSION);
    page += ".SH NAME\nhibi \\- turn one text file into a fracture film\n";
    page += ".SH SYNOPSIS\n.B hibi\n.I COMMAND\n[\\fIARGUMENT\\fR]...\n";
    page +=
        ".SH DESCRIPTION\n"
        "A scene, one TOML file, describes bodies, supports and loads. A particle solver breaks them; what\n"
        "happened is recorded, drawn and encoded.\n"
        ".B hibi new\nwrites a scene to start from,\n.B hibi run\nmakes the film.\n";
    for (const ArgumentText& option : program.options) page += option_entry(option);
    page += ".SH COMMANDS\n";
    for (const CommandText& command : describe_commands(app)) page += command_entry("hibi", command);
    page += ".SH FILES\n";
    page += files;
    page += ".SH EXIT STATUS\n" + roff(exit_status_of(app.get_footer()));
    page += ".SH EXAMPLES\n.nf\n" + examples_of(app.get_footer()) + ".fi\n";
    page +=
        ".SH REPORTING BUGS\nA report is easier to answer with the scene, what the program wrote, and the "
        "output "
        "of\n.BR \"hibi doctor\" .\n";
    return page;
}

}  // namespace hibi
