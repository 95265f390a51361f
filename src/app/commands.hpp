#pragma once

namespace CLI {
class App;
}

/// The commands of `hibi` in the order of its help. Each has a file of its own, commands/NAME.cpp, which
/// defines add_NAME; a new command is such a file and one line here.
#define HIBI_COMMANDS(COMMAND) \
    COMMAND(run)               \
    COMMAND(render)            \
    COMMAND(strip)             \
    COMMAND(figures)           \
    COMMAND(report)            \
    COMMAND(compare)           \
    COMMAND(diff)              \
    COMMAND(test)              \
    COMMAND(sweep)             \
    COMMAND(converge)          \
    COMMAND(verify)            \
    COMMAND(check)             \
    COMMAND(preview)           \
    COMMAND(new)               \
    COMMAND(reproduce)         \
    COMMAND(schema)            \
    COMMAND(completion)        \
    COMMAND(manual)            \
    COMMAND(doctor)

namespace hibi {

/// Adds a command with its options. When it is parsed it runs, and puts its exit status into `status`.
#define HIBI_DECLARE(NAME) void add_##NAME(CLI::App& app, int& status);
HIBI_COMMANDS(HIBI_DECLARE)
#undef HIBI_DECLARE

}  // namespace hibi
