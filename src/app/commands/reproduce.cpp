#include "app/reproduce.hpp"

#include "app/commands.hpp"
#include "app/shared_options.hpp"

namespace hibi {

void add_reproduce(CLI::App& app, int& status) {
    Command* reproduce = app.add_subcommand("reproduce", "Print the command that made a file");
    const auto o = options_of<ReproduceOptions>();
    reproduce->add_option("FILE", o->file, "picture, film, table, page, or folder of a run")->required();
    reproduce->add_flag("--json", o->json, "print JSON: title, version, scene hash, parameters, command");
    reproduce->callback([o, &status] { status = reproduce_command(*o); });
}

}  // namespace hibi
