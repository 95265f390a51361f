#include "app/manual.hpp"

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"

namespace hibi {

void add_manual(CLI::App& app, int& status) {
    app.add_subcommand("manual", "Print the man page, in roff")->callback([&app, &status] {
        fmt::print("{}", manual_page(app));
        status = 0;
    });
}

}  // namespace hibi
