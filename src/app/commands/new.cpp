#include "app/new.hpp"

#include "app/commands.hpp"
#include "app/shared_options.hpp"

namespace hibi {

void add_new(CLI::App& app, int& status) {
    Command* create = app.add_subcommand("new", "Write a commented scene to start from");
    const auto o = options_of<NewOptions>();
    create->add_option("NAME", o->name, "file to write (default: my_scene.toml)");
    create->add_option("--from", o->from, "start from this built-in scene")->type_name("SCENE");
    create->add_flag("--list", o->list, "list the built-in scenes");
    create->callback([o, &status] { status = new_command(*o); });
}

}  // namespace hibi
