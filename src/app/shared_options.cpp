#include "app/shared_options.hpp"

#include <fmt/format.h>

#include "base/parallel.hpp"
#include "film/encoder.hpp"
#include "image/difference.hpp"
#include "record/difference.hpp"

namespace hibi {

namespace {

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

}  // namespace

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

std::vector<std::string> words_of(const Overrides& overrides) {
    std::vector<std::string> words;
    for (const auto& [name, value] : overrides) words.insert(words.end(), {"-p", name + "=" + value});
    return words;
}

}  // namespace hibi
