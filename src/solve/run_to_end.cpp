#include "solve/run_to_end.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/units.hpp"
#include "scene/read.hpp"

namespace hibi {

namespace {

/// A body of a few particles makes them in an hour.
constexpr double most_steps = 1e9;

/// What the scene ties to a moment: the end of damping, the release of a load.
void pull_triggers(const Scene& scene, const Events& events, Simulation& simulation) {
    const auto reached = [&](const std::optional<Moment>& moment) {
        if (!moment) return false;
        const std::optional<double> time = events.time_of(*moment);
        return time && simulation.time() >= *time;
    };
    if (scene.damping && reached(scene.damping->until)) simulation.stop_damping();
    for (std::size_t l = 0; l < scene.loads.size(); ++l)
        if (reached(scene.loads[l].until)) simulation.release(static_cast<int>(l));
}

/// Is the run of that scene at its end?
bool reached_end(const Scene& scene, const RunMonitor& monitor, double time) {
    if (time >= scene.run.max_time) return true;
    if (!scene.run.until) return false;
    if (scene.run.until->event == EventName::peak_load && !monitor.peak_confirmed()) return false;
    const std::optional<double> end = monitor.events().time_of(*scene.run.until);
    return end && time >= *end;
}

}  // namespace

std::optional<std::string> run_to_end(const Scene& scene, Simulation& simulation, RunMonitor& monitor,
                                      const AfterStep& after_step, StageTimes* profile) {
    while (!reached_end(scene, monitor, simulation.time())) {
        simulation.step();
        {
            const TimedStage timed(profile, "watch");
            monitor.look();
        }
        if (simulation.failure()) return simulation.failure();
        if (simulation.collapse()) {
            after_step();
            return monitor.events().first_break ? std::nullopt : simulation.collapse();
        }
        pull_triggers(scene, monitor.events(), simulation);
        if (const std::optional<std::string> obstacle = after_step()) return obstacle;
    }
    return {};
}

void require_separable(const Scene& scene, const RunMonitor& monitor) {
    const auto asks = [](const std::optional<Moment>& m) { return m && m->event == EventName::separation; };
    const bool asked = asks(scene.run.until) || (scene.damping && asks(scene.damping->until)) ||
                       std::any_of(scene.loads.begin(), scene.loads.end(),
                                   [&](const LoadSpec& load) { return asks(load.until); });
    if (!asked || monitor.can_separate()) return;
    throw SceneErrors(
        scene.file.string(), "",
        {{.message =
              "separation cannot happen: no bonds lead from a held particle to one of the primary [[load]], "
              "even before the run (a particle that is both counts as loaded)"}});
}

void require_steps_that_end(const Scene& scene, const Simulation& simulation) {
    const double steps = scene.run.max_time / simulation.time_step();
    if (steps <= most_steps) return;
    throw SceneErrors(
        scene.file.string(), "",
        {{.message = fmt::format(
              "[run] max_time: {} are {:.2g} steps of {}, which would not end; at most {:g}",
              format_si(scene.run.max_time, "s"), steps, format_si(simulation.time_step(), "s"), most_steps),
          .hint =
              "lower max_time or raise the spacing; are the units of youngs_modulus and density right?"}});
}

}  // namespace hibi
