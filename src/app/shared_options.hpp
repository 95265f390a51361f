#pragma once
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pictures/draw.hpp"
#include "render/renderer.hpp"
#include "scene/read.hpp"
#include "studies/study_runs.hpp"

namespace hibi {

using Command = CLI::App;

/// The values that a command's options are put into: they live as long as the command itself.
template <class Options>
std::shared_ptr<Options> options_of() {
    return std::make_shared<Options>();
}

// Options that several commands have: each is declared once.

/// A scene as a word of the command line: "-" is standard input, as for other commands.
std::string scene_word(const std::string& word);
/// SCENE and -p name=value.
void add_scene(Command& command, std::filesystem::path& scene, Overrides& overrides);
/// --gl, --shaders.
void add_drawing(Command& command, RendererOptions& renderer);
void add_formats(Command& command, std::vector<std::string>& formats);
/// --formats, --no-movie, --no-report.
void add_movie(Command& command, DrawOptions& draw);
void add_threads(Command& command);
void add_quiet(Command& command, bool& quiet);
void add_profile(Command& command, bool& profile);
/// Every threshold of a comparison, its default shown.
void add_tolerance(Command& command, TestLimits& limits);
/// -p name=value,value, -o, --jobs, --force, -q. `folder` is the help of -o.
void add_study(Command& command, std::vector<std::string>& grid, StudyOptions& study, const char* folder);

/// The words "-p", "name=value" for each override, as they stand in a command that gives a result again.
std::vector<std::string> words_of(const Overrides& overrides);

}  // namespace hibi
