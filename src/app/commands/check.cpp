#include "app/check.hpp"

#include "app/commands.hpp"
#include "app/shared_options.hpp"

namespace hibi {

void add_check(CLI::App& app, int& status) {
    Command* check =
        app.add_subcommand("check", "Read a scene and say what would be modelled; nothing is run");
    const auto o = options_of<CheckOptions>();
    add_scene(*check, o->scene, o->overrides);
    check->add_flag("--json", o->json, "print JSON");
    check->callback([o, &status] { status = check_command(*o); });
}

}  // namespace hibi
