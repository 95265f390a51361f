#pragma once
#include <string>

namespace CLI {
class App;
}

namespace hibi {

/// The man page of the program, hibi(1), in roff: every command with its arguments and options as its help
/// tells them; examples and exit status from the footer of the program's help.
std::string manual_page(const CLI::App& app);

}  // namespace hibi
