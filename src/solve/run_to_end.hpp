#pragma once
#include <functional>
#include <optional>
#include <string>

#include "base/stage_time.hpp"
#include "measure/run_monitor.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// Is called after each step, when the monitor has looked and the scene's triggers have been pulled. Returns
/// why the run cannot go on, if it cannot.
using AfterStep = std::function<std::optional<std::string>()>;

/// Moves the simulation step by step to the end that its scene asks for: the one loop of every run. Returns
/// why it stopped early, if it did. A static run whose body collapses after a break has come to its end: that
/// is how a fracture may end. `profile` takes the time of the monitor.
std::optional<std::string> run_to_end(const Scene& scene, Simulation& simulation, RunMonitor& monitor,
                                      const AfterStep& after_step, StageTimes* profile = nullptr);

/// Throws SceneErrors where the scene waits for a separation that cannot happen, since nothing holds what is
/// loaded.
void require_separable(const Scene& scene, const RunMonitor& monitor);

/// Throws SceneErrors where the run would take more steps than anyone can wait for.
void require_steps_that_end(const Scene& scene, const Simulation& simulation);

}  // namespace hibi
