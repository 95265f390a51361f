#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "measure/run_monitor.hpp"
#include "pictures/draw.hpp"
#include "scene/read.hpp"

namespace hibi {

struct RunOptions {
    std::filesystem::path scene;
    std::optional<std::filesystem::path> folder{};  ///< absent: out/<scene name>
    Overrides overrides{};
    bool pictures = true;  ///< draw at all
    bool force = false;    ///< overwrite the run of another scene
    bool quiet = false;    ///< no progress
    bool json = false;     ///< print run.json instead of the table
    bool profile = false;  ///< measure how long each stage takes
    DrawOptions draw{};
};

/// Simulates, records, draws, encodes and reports. Returns the exit status: 0 done, 1 the run blew up, 4 its
/// energy balance cannot be trusted. Throws SceneErrors for a wrong scene and std::runtime_error for the
/// world's faults.
int run_command(const RunOptions& options);

/// Throws SceneErrors where the scene waits for a separation that cannot happen, since nothing holds what is
/// loaded.
void require_separable(const Scene& scene, const RunMonitor& watch);

/// Throws SceneErrors where the run would take more steps than anyone can wait for.
void require_steps_that_end(const Scene& scene, const Simulation& simulation);

/// What the scene ties to a moment: the end of damping, the release of a load. After every step.
void pull_triggers(const Scene& scene, const Events& events, Simulation& simulation);
/// Is the run of that scene at its end?
bool reached_end(const Scene& scene, const RunMonitor& watch, double time);

struct RenderOptions {
    std::filesystem::path folder;
    std::optional<std::filesystem::path> scene{};  ///< of [view] and [movie]; absent: as recorded
    bool quiet = false;
    bool profile = false;  ///< measure how long each stage takes
    DrawOptions draw{};
};

/// Pictures and film of a recorded run once more.
int render_command(const RenderOptions& options);

}  // namespace hibi
