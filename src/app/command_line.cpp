#include "app/command_line.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "app/check.hpp"
#include "app/compare.hpp"
#include "app/completion.hpp"
#include "app/converge.hpp"
#include "app/diff.hpp"
#include "app/doctor.hpp"
#include "app/draw.hpp"
#include "app/figures.hpp"
#include "app/manual.hpp"
#include "app/new.hpp"
#include "app/report.hpp"
#include "app/reproduce.hpp"
#include "app/run.hpp"
#include "app/test_scenes.hpp"
#include "app/verify.hpp"
#include "base/parallel.hpp"
#include "film/encoder.hpp"
#include "record/provenance.hpp"
#include "scene/read.hpp"
#include "scene/schema.hpp"

namespace hibi {

namespace {

constexpr const char* examples = R"(
Examples:
  hibi run scenes/bending_fine.toml            simulate, draw, encode: out/bending_fine/movie.mp4
  hibi run scene.toml -p spacing=0.5m -o out/fine
  hibi check scene.toml                        what would be modelled, and how long it would take
  hibi preview scene.toml -o setup.png         supports, loads and notches in one picture
  hibi render out/bending_fine                 draw again from the recorded states
  hibi diff out/before out/after               which bond broke first at another time
  hibi test scenes/                            compare with the references beside the scenes
  hibi reproduce figure.png                    the command that made it
  hibi verify --quick                          how accurate it is, and how fast
  hibi new my_scene.toml                       a commented scene to start from

Exit status: 0 done, 1 it failed, 2 the input is wrong, 3 pictures or runs differ,
4 done, but the energy balance is off by more than 2 %.
)";

using Command = CLI::App;
/// The values that a command's options are put into: they live as long as the command itself.
template <class Options>
std::shared_ptr<Options> options_of() {
    return std::make_shared<Options>();
}

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

/// "-" is standard input, as for other commands.
std::string scene_word(const std::string& word) { return word == "-" ? "/dev/stdin" : word; }

void add_scene(Command& command, std::filesystem::path& scene, Overrides& overrides) {
    command.add_option("SCENE", scene, "scene file (TOML), or - for standard input")
        ->required()
        ->transform(scene_word);
    command
        .add_option_function<std::vector<std::string>>(
            "-p,--param",
            [&overrides](const std::vector<std::string>& texts) { overrides = overrides_from(texts); },
            "override a value of [params], name=value; may be repeated")
        ->allow_extra_args(false)
        ->type_name("NAME=VALUE");
}

void add_drawing(Command& command, RendererOptions& renderer) {
    command
        .add_option_function<std::string>(
            "--gl",
            [&renderer](const std::string& name) {
                renderer.backend = name == "egl" ? GlBackend::egl : GlBackend::osmesa;
            },
            "OpenGL by osmesa (default) or egl; both give the same pixels")
        ->check(CLI::IsMember({"osmesa", "egl"}))
        ->type_name("TEXT");
    command.add_option("--shaders", renderer.shaders, "read the shaders from this folder");
}

void add_formats(Command& command, std::vector<std::string>& formats) {
    command
        .add_option("--formats", formats,
                    "films to make: mp4, gif, webm, apng, webp (default: [movie] formats); films of other "
                    "formats stay")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::IsMember(film_formats()))
        ->type_name("TEXT");
}

void add_movie(Command& command, DrawOptions& draw) {
    add_formats(command, draw.formats);
    command.add_flag_callback(
        "--no-movie", [&draw] { draw.movie = draw.frames = false; },
        "neither frames nor film, and none stays from before: poster, figures and report only");
    command.add_flag_callback(
        "--no-report", [&draw] { draw.report = false; }, "neither figures nor report");
}

void add_threads(Command& command) {
    command
        .add_option_function<int>("--threads", set_threads,
                                  "threads of the solver (default: all cores); the bits stay the same")
        ->check(CLI::Range(1, 1024))
        ->type_name("INT");
}

void add_quiet(Command& command, bool& quiet) { command.add_flag("-q,--quiet", quiet, "no progress"); }

void add_profile(Command& command, bool& profile) {
    command.add_flag("--profile", profile,
                     "measure how long each stage takes: a table, and \"profile\" in run.json");
}

void add_run(CLI::App& app, int& status) {
    Command* run = app.add_subcommand("run", "Simulate a scene, draw it and encode the film");
    const auto o = options_of<RunOptions>();
    add_scene(*run, o->scene, o->overrides);
    run->add_option("-o,--output", o->folder, "folder of the run (default: out/<scene name>)");
    add_movie(*run, o->draw);
    run->add_flag_callback(
        "--no-pictures", [o] { o->pictures = false; }, "simulate and record only");
    run->add_flag("--force", o->force, "overwrite the folder of another scene's run");
    run->add_flag("--json", o->json, "print run.json instead of the table");
    add_drawing(*run, o->draw.renderer);
    add_threads(*run);
    add_profile(*run, o->profile);
    add_quiet(*run, o->quiet);
    run->callback([o, &status] { status = run_command(*o); });
}

void add_render(CLI::App& app, int& status) {
    Command* render = app.add_subcommand("render", "Draw a recorded run again, without simulating");
    const auto o = options_of<RenderOptions>();
    render->add_option("DIR", o->folder, "folder of the run")->required();
    render->add_option("--scene", o->scene,
                       "take [view] and [movie] from this scene instead of DIR/scene.toml");
    add_movie(*render, o->draw);
    add_drawing(*render, o->draw.renderer);
    add_threads(*render);
    add_profile(*render, o->profile);
    add_quiet(*render, o->quiet);
    render->callback([o, &status] { status = render_command(*o); });
}

void add_strip(CLI::App& app, int& status) {
    Command* strip = app.add_subcommand("strip", "Key frames of a recorded run in one picture");
    const auto o = options_of<StripOptions>();
    strip->add_option("DIR", o->folder, "folder of the run")->required();
    strip->add_option("-o,--output", o->output, "PNG to write (default: DIR/strip.png)");
    strip->add_option("--theme", o->theme, "dark, light or print (default: the scene's)")
        ->check(CLI::IsMember(theme_names()))
        ->type_name("TEXT");
    strip->add_option("--width", o->width_mm, "in mm, at 300 dpi")
        ->check(CLI::Range(20, 1000))
        ->capture_default_str();
    strip->add_option("--columns", o->columns, "pictures in a row (default: as many as stay readable)")
        ->check(CLI::Range(1, 100));
    add_drawing(*strip, o->renderer);
    strip->callback([o, &status] { status = strip_command(*o); });
}

void add_figures(CLI::App& app, int& status) {
    Command* figures =
        app.add_subcommand("figures", "Strip, crack history and curves of a recorded run, for print");
    const auto o = options_of<FiguresOptions>();
    figures->add_option("DIR", o->folder, "folder of the run")->required();
    figures->add_option("-o,--output", o->output, "folder to write to (default: DIR/figures)");
    figures
        ->add_option("--theme", o->themes, "dark, light, print, several with commas (default: the scene's)")
        ->check(CLI::IsMember(theme_names()))
        ->delimiter(',')
        ->type_name("TEXT");
    figures->add_option("--width", o->widths, "in mm, at 300 dpi, several with commas (default: 170)")
        ->check(CLI::Range(20, 1000))
        ->delimiter(',');
    add_drawing(*figures, o->renderer);
    figures->callback([o, &status] { status = figures_command(*o); });
}

void add_report(CLI::App& app, int& status) {
    Command* report = app.add_subcommand("report", "Page, caption and snippets of a recorded run once more");
    const auto o = options_of<ReportOptions>();
    report->add_option("DIR", o->folder, "folder of the run")->required();
    add_drawing(*report, o->renderer);
    report->callback([o, &status] { status = report_command(*o); });
}

void add_compare(CLI::App& app, int& status) {
    Command* compare =
        app.add_subcommand("compare", "One film of several runs, on one clock and with one colour range");
    const auto o = options_of<CompareOptions>();
    compare->add_option("DIR", o->folders, "folders of the runs")->required();
    compare->add_option("-o,--output", o->output, "folder of the film")->capture_default_str();
    compare
        ->add_option_function<std::string>(
            "--align", [o](const std::string& name) { o->align = event_from(name); },
            "let all clocks agree at first_break, peak_load or separation")
        ->check(CLI::IsMember({"first_break", "peak_load", "separation"}))
        ->type_name("TEXT");
    compare->add_option("--label", o->labels, "name of a run, once for each (default: what tells them apart)")
        ->allow_extra_args(false);
    compare->add_option("--title", o->title, "of the film (default: that of the first run)");
    compare->add_option("--columns", o->columns, "panels in a row (default: so that the bodies are largest)")
        ->check(CLI::Range(1, 100));
    compare
        ->add_option_function<std::string>(
            "--size",
            [o](const std::string& text) {
                int width = 0, height = 0;
                char rest = 0;
                if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 64 ||
                    height < 64 || width % 2 || height % 2)
                    throw CLI::ValidationError("--size",
                                               "needs even numbers of pixels, for example 1920x1080");
                o->size = {width, height};
            },
            "WIDTHxHEIGHT (default: that of the first run's film)")
        ->type_name("TEXT");
    add_formats(*compare, o->formats);
    compare->add_flag("--force", o->force, "write into a folder that holds other things");
    add_drawing(*compare, o->renderer);
    add_quiet(*compare, o->quiet);
    compare->callback([o, &status] { status = compare_command(*o); });
}

/// Every threshold of a comparison, its default shown.
void add_tolerance(Command& command, TestLimits& limits) {
    const Tolerance pixels;
    const RunTolerance run;
    const auto add = [&](const char* name, auto& limit, auto standard, const char* meaning) {
        command.add_option(name, limit, meaning)
            ->check(CLI::NonNegativeNumber)
            ->default_str(fmt::format("{}", standard));
    };
    add("--tile", limits.tile, pixels.tile, "worst 32 x 32 tile: RMS difference of luma, in steps of 1/255");
    add("--pixels", limits.pixels, pixels.pixels, "pixels per megapixel with a channel off by more than 16");
    add("--mean", limits.mean, pixels.mean, "mean signed difference of any channel");
    add("--rmse", limits.rmse, pixels.rmse, "RMS difference of any channel");
    add("--position", limits.position, run.position, "difference of positions, in particle spacings");
    add("--break-steps", limits.break_steps, run.break_steps,
        "steps by which a bond may break earlier or later");
    add("--load", limits.load, run.load, "difference of loads, in parts of the peak load");
}

void add_diff(CLI::App& app, int& status) {
    Command* diff = app.add_subcommand(
        "diff", "Compare two pictures, films or runs: has the drawing changed, or the physics?");
    const auto o = options_of<DiffOptions>();
    diff->add_option("EXPECTED", o->expected, "PNG, folder of PNGs, frames.json, or folder of a run")
        ->required();
    diff->add_option("ACTUAL", o->actual, "another of the same kind")->required();
    diff->add_option("-o,--output", o->output, "folder of the pictures and the page")->capture_default_str();
    diff->add_flag("--json", o->json, "print JSON instead of the verdict");
    diff->add_option("--junit", o->junit, "write JUnit XML to this file");
    const auto limits = options_of<TestLimits>();
    add_tolerance(*diff, *limits);
    diff->callback([o, limits, &status] {
        set_limits(*limits, o->pixels, o->run);
        status = diff_command(*o);
    });
}

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
    test->callback([o, &status] { status = test_command(*o); });
}

void add_study(Command& command, std::vector<std::string>& grid, StudyOptions& study, const char* folder) {
    command.add_option("-p,--param", grid, "values of one of [params], name=value,value,...")
        ->allow_extra_args(false)
        ->required();
    command.add_option("-o,--output", study.folder, folder);
    command.add_option("--jobs", study.jobs, "runs at once (default: one per core)")
        ->check(CLI::Range(1, 1024));
    command.add_flag("--force", study.force, "run again what is there already; write into any folder");
    add_quiet(command, study.quiet);
}

void add_sweep(CLI::App& app, int& status) {
    Command* sweep =
        app.add_subcommand("sweep", "Run a scene for all combinations of parameters: table, sheet, plot");
    const auto o = options_of<SweepOptions>();
    sweep->add_option("SCENE", o->scene, "scene file (TOML)")->required()->transform(scene_word);
    add_study(*sweep, o->grid, o->study, "folder of the runs (default: out/<scene name>_sweep)");
    sweep->add_flag("--pictures", o->study.pictures, "film, figures and report of every run, too");
    sweep->add_flag("--json", o->json, "print sweep.json instead of the table");
    add_drawing(*sweep, o->renderer);
    sweep->callback([o, &status] { status = sweep_command(*o); });
}

void add_converge(CLI::App& app, int& status) {
    Command* converge =
        app.add_subcommand("converge", "The same experiment at several resolutions: table, plot, film");
    const auto o = options_of<ConvergeOptions>();
    converge->add_option("SCENE", o->scene, "scene file (TOML)")->required()->transform(scene_word);
    add_study(*converge, o->grid, o->study, "folder of the runs (default: out/<scene name>_converge)");
    converge->add_flag_callback(
        "--one", [o] { o->both = false; }, "only with the scene's own criterion of failure, not with both");
    converge->add_flag_callback(
        "--no-movie", [o] { o->film = false; }, "no film side by side");
    converge->add_flag("--json", o->json, "print converge.json instead of the table");
    add_drawing(*converge, o->renderer);
    converge->callback([o, &status] { status = converge_command(*o); });
}

void add_verify(CLI::App& app, int& status) {
    Command* verify =
        app.add_subcommand("verify", "Accuracy and speed, against answers that are known without particles");
    const auto o = options_of<VerifyOptions>();
    verify->add_option("--case", o->cases, "only this case; may be repeated")->allow_extra_args(false);
    verify->add_option("--variant", o->variant, "default or thesis, of elasticity (default: both)")
        ->check(CLI::IsMember({"default", "thesis"}))
        ->type_name("TEXT");
    verify->add_flag("--list", o->list, "list the cases");
    verify->add_flag("--quick", o->quick, "coarse resolutions only: less than a minute on two cores");
    verify->add_option("--goals", o->goals, "multiply the errors that are allowed by this")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    verify->add_option("-o,--output", o->folder, "folder to write to")->capture_default_str();
    verify->add_flag("--json", o->json, "print verify.json instead of the table");
    add_threads(*verify);
    add_quiet(*verify, o->quiet);
    verify->callback([o, &status] { status = verify_command(*o); });
}

void add_check(CLI::App& app, int& status) {
    Command* check =
        app.add_subcommand("check", "Read a scene and say what would be modelled; nothing is run");
    const auto o = options_of<CheckOptions>();
    add_scene(*check, o->scene, o->overrides);
    check->add_flag("--json", o->json, "print JSON");
    check->callback([o, &status] { status = check_command(*o); });
}

void add_preview(CLI::App& app, int& status) {
    Command* preview = app.add_subcommand("preview", "Picture of the body with supports, loads and notches");
    const auto o = options_of<PreviewOptions>();
    add_scene(*preview, o->scene, o->overrides);
    preview->add_option("-o,--output", o->png, "PNG to write")->capture_default_str();
    add_drawing(*preview, o->renderer);
    preview->callback([o, &status] {
        std::vector<std::string> words{"hibi", "preview", path_word(o->scene)};
        for (const auto& [name, value] : o->overrides) words.insert(words.end(), {"-p", name + "=" + value});
        words.insert(words.end(), {"-o", path_word(o->png)});
        draw_setup(read_and_build(o->scene, o->overrides), o->png, o->renderer, shell_command(words));
        fmt::print("{}\n", o->png.string());
        status = 0;
    });
}

void add_new(CLI::App& app, int& status) {
    Command* create = app.add_subcommand("new", "Write a commented scene to start from");
    const auto o = options_of<NewOptions>();
    create->add_option("NAME", o->name, "file to write (default: my_scene.toml)");
    create->add_option("--from", o->from, "start from this built-in scene")->type_name("SCENE");
    create->add_flag("--list", o->list, "list the built-in scenes");
    create->callback([o, &status] { status = new_command(*o); });
}

void add_reproduce(CLI::App& app, int& status) {
    Command* reproduce = app.add_subcommand("reproduce", "Print the command that made a file");
    const auto o = options_of<ReproduceOptions>();
    reproduce->add_option("FILE", o->file, "picture, film, table, page, or folder of a run")->required();
    reproduce->add_flag("--json", o->json, "print JSON: title, version, scene hash, parameters, command");
    reproduce->callback([o, &status] { status = reproduce_command(*o); });
}

void add_schema(CLI::App& app, int& status) {
    Command* schema = app.add_subcommand("schema", "Print the JSON Schema of scene files, for editors");
    schema->callback([&status] {
        fmt::print("{}", scene_schema());
        status = 0;
    });
}

void add_completion(CLI::App& app, int& status) {
    Command* completion = app.add_subcommand("completion", "Print the completion script of a shell");
    const auto shell = options_of<std::string>();
    completion->add_option("SHELL", *shell, "bash, zsh or fish")
        ->required()
        ->check(CLI::IsMember(completion_shells()));
    completion->callback([shell, &app, &status] {
        fmt::print("{}", completion_script(app, *shell));
        status = 0;
    });
}

void add_manual(CLI::App& app, int& status) {
    app.add_subcommand("manual", "Print the man page, in roff")->callback([&app, &status] {
        fmt::print("{}", manual_page(app));
        status = 0;
    });
}

void add_doctor(CLI::App& app, int& status) {
    Command* doctor = app.add_subcommand("doctor", "What works on this machine, and what to install");
    const auto json = options_of<bool>();
    doctor->add_flag("--json", *json, "print JSON");
    doctor->callback([json, &status] { status = doctor_command(*json); });
}

}  // namespace

std::shared_ptr<CLI::App> make_command_line(int& status) {
    auto app = std::make_shared<CLI::App>("hibi turns one text file into a fracture film.", "hibi");
    app->footer(examples);
    app->require_subcommand(1);
    app->set_version_flag("--version", "hibi " HIBI_VERSION);
    app->set_help_all_flag("--help-all", "Help of every command");
    for (const auto add : {add_run, add_render, add_strip, add_figures, add_report, add_compare, add_diff,
                           add_test, add_sweep, add_converge, add_verify, add_check, add_preview, add_new,
                           add_reproduce, add_schema, add_completion, add_manual, add_doctor})
        add(*app, status);
    for (CLI::App* command : app->get_subcommands({}))
        command->footer("");  // the examples stand in hibi --help
    return app;
}

int run_command_line(int argc, char** argv) {
    int status = 2;
    const std::shared_ptr<CLI::App> app = make_command_line(status);
    std::vector<std::string> words;
    for (const CLI::App* command : app->get_subcommands({})) words.push_back(command->get_name());
    if (argc > 1 && argv[1][0] != '-' && std::ranges::find(words, argv[1]) == words.end()) {
        fmt::print(stderr, "hibi: error: unknown command \"{}\"; known: {}\n", argv[1],
                   fmt::join(words, ", "));
        return 2;
    }
    try {
        app->parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app->exit(error) == 0 ? 0 : 2;
    }
    return status;
}

}  // namespace hibi
