#pragma once
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace hibi {

/// Shells that completion_script knows: bash, zsh, fish.
const std::vector<std::string>& completion_shells();

/// A script that teaches a shell to complete the program's commands, their options with what they do, the
/// values of options that have few, and files elsewhere. Throws std::out_of_range for another shell.
std::string completion_script(const CLI::App& app, const std::string& shell);

}  // namespace hibi
