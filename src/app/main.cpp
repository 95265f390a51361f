#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "app/check.hpp"
#include "app/doctor.hpp"
#include "app/draw.hpp"
#include "app/new.hpp"
#include "app/run.hpp"
#include "base/parallel.hpp"
#include "scene/read.hpp"

namespace {

using namespace hibi;

constexpr const char* examples = R"(
Examples:
  hibi run scenes/bending_fine.toml            simulate, draw, encode: out/bending_fine/movie.mp4
  hibi run scene.toml -p spacing=0.5m -o out/fine
  hibi check scene.toml                        what would be modelled, and how long it would take
  hibi preview scene.toml -o setup.png         supports, loads and notches in one picture
  hibi render out/bending_fine                 draw again from the recorded states
  hibi new my_scene.toml                       a commented scene to start from

Exit status: 0 done, 1 it failed, 2 the input is wrong, 4 done, but the energy balance is off by more than 2 %.
)";

/// -p name=value, with spaces around the = allowed.
Overrides overrides_from(const std::vector<std::string>& texts) {
    Overrides overrides;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw CLI::ValidationError("-p", fmt::format("\"{}\" is not of the form name=value", text));
        overrides.push_back({text.substr(0, equals), text.substr(equals + 1)});
    }
    return overrides;
}

int command_line(int argc, char** argv) {
    CLI::App app{"hibi turns one text file into a fracture film."};
    app.footer(examples);
    app.require_subcommand(1);
    app.set_version_flag("--version", "hibi " HIBI_VERSION);
    app.set_help_all_flag("--help-all", "Help of every command");

    std::string gl = "osmesa", scene, folder, png = "setup.png", name, template_name, view;
    std::vector<std::string> parameters;
    bool no_movie = false, force = false, quiet = false, json = false, list = false;
    int thread_count = 0;
    DrawOptions draw;

    const auto scene_options = [&](CLI::App* command) {
        command->add_option("SCENE", scene, "scene file (TOML)")->required();
        command
            ->add_option("-p,--param", parameters,
                         "override a value of [params], name=value; may be repeated")
            ->allow_extra_args(false);
    };
    const auto drawing_options = [&](CLI::App* command) {
        command->add_option("--gl", gl, "OpenGL by osmesa (default) or egl; both give the same pixels")
            ->check(CLI::IsMember({"osmesa", "egl"}));
        command->add_option("--shaders", draw.renderer.shaders, "read the shaders from this folder");
    };
    const auto common = [&](CLI::App* command) {
        command
            ->add_option("--threads", thread_count,
                         "threads of the solver (default: all cores); the bits stay the same")
            ->check(CLI::Range(1, 1024));
        command->add_flag("-q,--quiet", quiet, "no progress");
    };

    CLI::App* run = app.add_subcommand("run", "Simulate a scene, draw it and encode the film");
    scene_options(run);
    run->add_option("-o,--output", folder, "folder of the run (default: out/<scene name>)");
    run->add_flag("--no-movie", no_movie, "simulate and record only");
    run->add_flag("--force", force, "overwrite the folder of another scene's run");
    run->add_flag("--json", json, "print run.json instead of the table");
    drawing_options(run);
    common(run);

    CLI::App* render = app.add_subcommand("render", "Draw a recorded run again, without simulating");
    render->add_option("DIR", folder, "folder of the run")->required();
    render->add_option("--scene", view, "take [view] and [movie] from this scene instead of DIR/scene.toml");
    render->add_flag("--no-movie", no_movie, "frames and poster only");
    drawing_options(render);
    common(render);

    CLI::App* check =
        app.add_subcommand("check", "Read a scene and say what would be modelled; nothing is run");
    scene_options(check);
    check->add_flag("--json", json, "print JSON");

    CLI::App* preview = app.add_subcommand("preview", "Picture of the body with supports, loads and notches");
    scene_options(preview);
    preview->add_option("-o,--output", png, "PNG to write")->capture_default_str();
    drawing_options(preview);

    CLI::App* create = app.add_subcommand("new", "Write a commented scene to start from");
    create->add_option("NAME", name, "file to write (default: my_scene.toml)");
    create->add_option("--from", template_name, "start from this built-in scene");
    create->add_flag("--list", list, "list the built-in scenes");

    CLI::App* doctor = app.add_subcommand("doctor", "What works on this machine, and what to install");
    doctor->add_flag("--json", json, "print JSON");

    for (CLI::App* command : app.get_subcommands({}))
        command->footer("");  // the examples stand in hibi --help
    const auto is_command = [&](const std::string& word) {
        return std::ranges::any_of(app.get_subcommands({}),
                                   [&](CLI::App* c) { return c->get_name() == word; });
    };
    if (argc > 1 && argv[1][0] != '-' && !is_command(argv[1])) {
        fmt::print(stderr,
                   "hibi: error: unknown command \"{}\"; known: run, render, check, preview, new, doctor\n",
                   argv[1]);
        return 2;
    }
    try {
        app.parse(argc, argv);
        if (thread_count > 0) set_threads(thread_count);
        const Overrides overrides = overrides_from(parameters);
        draw.movie = !no_movie;
        if (gl == "egl") draw.renderer.backend = GlBackend::egl;
        if (*run) {
            RunOptions options{.scene = scene,
                               .overrides = overrides,
                               .movie = !no_movie,
                               .force = force,
                               .quiet = quiet,
                               .json = json,
                               .draw = draw};
            if (!folder.empty()) options.folder = folder;
            return run_command(options);
        }
        if (*render) {
            std::optional<std::filesystem::path> file;
            if (!view.empty()) file = view;
            return render_command(folder, file, draw, quiet);
        }
        if (*check) return check_command(scene, overrides, json);
        if (*preview) {
            draw_setup(read_scene(scene, overrides), png, draw);
            fmt::print("{}\n", png);
            return 0;
        }
        if (*create) return new_command(name, template_name, list);
        if (*doctor) return doctor_command(json);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return 2;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return command_line(argc, argv);
    } catch (const hibi::SceneErrors& errors) {
        fmt::print(stderr, "{}\n", errors.what());
        return 2;
    } catch (const std::exception& error) {
        fmt::print(stderr, "hibi: error: {}\n", error.what());
        return 1;
    }
}
