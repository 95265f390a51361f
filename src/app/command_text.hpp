#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace hibi {

/// An option or argument of a command, as completion and the man page tell it.
struct ArgumentText {
    std::vector<std::string> names;    ///< "-o", "--output"; of an argument its one name, "SCENE"
    std::string help;                  ///< what it does
    std::string value;                 ///< name of what follows it; empty for a flag
    std::vector<std::string> choices;  ///< values it can have, where they are few
    bool required = false;

    bool takes_file() const { return value == "TEXT" && choices.empty(); }  // the name of any text or path
};

struct CommandText {
    std::string name, help;
    std::vector<ArgumentText> options, arguments;
};

/// What the command line says of one command, or of the whole program without its commands.
CommandText describe(const CLI::App& command);
/// The commands of a program in the order of its help.
std::vector<CommandText> describe_commands(const CLI::App& app);

}  // namespace hibi
