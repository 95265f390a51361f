#pragma once
#include <filesystem>

namespace hibi {

struct ReproduceOptions {
    std::filesystem::path file;
    bool json = false;  ///< print everything that is known instead of the command alone
};

/// `hibi reproduce`: prints the command that made a picture, film, table, page or run folder, from what the
/// file itself says. Notes on standard error what would make it come out otherwise now: another version of
/// the program, a scene file that has changed or is gone. Returns the exit status: 2 for a file that says
/// nothing.
int reproduce_command(const ReproduceOptions& options);

}  // namespace hibi
