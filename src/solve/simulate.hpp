#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "record/run_folder.hpp"
#include "scene/read.hpp"

namespace hibi {

struct SimulateOptions {
    std::filesystem::path folder;  ///< of the run
    Overrides overrides{};         ///< that the scene was read with, for the summary
    std::string command{};         ///< that gives this run again
    bool quiet = false;            ///< no progress
    bool profile = false;          ///< measure how long each stage takes
    /// From here on the setup is timed: when the scene began to be read.
    std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
};

/// Simulates a scene and records it into a folder: states, tables and run.json. The summary says why it
/// stopped, if it did, and holds the warnings. Throws SceneErrors for a scene that cannot end,
/// std::runtime_error for the world's faults.
RunSummary simulate(const Scene& scene, Built<2> built, const SimulateOptions& options);

/// A folder is used that is empty, or holds the run of the same scene; any other is refused
/// (std::runtime_error) unless `force` says otherwise. What would write over the scene itself is refused in
/// any case. A scene from a pipe has no file by which it could be known again: it is the same only where
/// nothing in it has changed.
void refuse_other_scene(const std::filesystem::path& folder, const Scene& scene, bool force);

/// A number that lost its unit on the command line is taken as SI, which may be far from what was meant: one
/// note for each. `text` is that of the scene, and `name` its name.
std::vector<std::string> notes_on_plain_numbers(const std::string& text, const std::string& name,
                                                const Overrides& overrides);

}  // namespace hibi
