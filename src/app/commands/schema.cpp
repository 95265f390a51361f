#include "scene/schema.hpp"

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"

namespace hibi {

void add_schema(CLI::App& app, int& status) {
    Command* schema = app.add_subcommand("schema", "Print the JSON Schema of scene files, for editors");
    schema->callback([&status] {
        fmt::print("{}", scene_schema());
        status = 0;
    });
}

}  // namespace hibi
