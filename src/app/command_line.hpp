#pragma once
#include <memory>
#include <string>

namespace CLI {
class App;
}

namespace hibi {

/// The commands of `hibi` with their options, ready to parse; completion and the man page are written from
/// it. Parsing runs the command that was asked for and puts its exit status into `status`.
std::shared_ptr<CLI::App> make_command_line(int& status);

/// Parses and runs. Returns the exit status: 0 done, 1 it failed, 2 the input is wrong, 3 images or runs
/// differ, 4 the run finished, but its energy balance cannot be trusted. Throws what the commands throw;
/// std::invalid_argument stands for wrong input.
int run_command_line(int argc, char** argv);

}  // namespace hibi
