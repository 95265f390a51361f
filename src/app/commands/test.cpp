#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/shared_options.hpp"
#include "picture_tests/test_results.hpp"
#include "picture_tests/test_scenes.hpp"

namespace hibi {

void add_test(CLI::App& app, int& status) {
    Command* test =
        app.add_subcommand("test", "Image tests: run scenes and compare them with stored references");
    const auto o = options_of<TestOptions>();
    test->add_option("SCENE", o->scenes, "scene files (TOML), or folders of them")
        ->required()
        ->transform(scene_word);
    test->add_option_function<std::string>(
            "--update",
            [o](const std::string& what) {
                o->update = what == "all"       ? Update::all
                            : what == "changed" ? Update::changed
                                                : Update::missing;
            },
            "write references: those missing, those too that changed, or all; old pictures stay as *.old.png")
        ->check(CLI::IsMember({"missing", "changed", "all"}))
        ->type_name("TEXT");
    test->add_option("-o,--output", o->output, "folder for runs and pictures of what fails")
        ->capture_default_str();
    test->add_option("--jobs", o->jobs, "scenes at once (default: one per core)")->check(CLI::Range(1, 1024));
    test->add_flag("--json", o->json, "print JSON instead of lines");
    test->add_option("--junit", o->junit, "write JUnit XML to this file");
    add_tolerance(*test, o->limits);
    add_drawing(*test, o->renderer);
    add_quiet(*test, o->quiet);
    test->callback([o, &status] {
        const std::vector<SceneResult> results = test_scenes(*o);
        fmt::print("{}", o->json ? results_json(results) : results_text(results));
        status = test_status(results);
    });
}

}  // namespace hibi
