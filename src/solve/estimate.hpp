#pragma once
#include <cstdint>

#include "simulation/simulation.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// What a run would cost if it went on to max_time: an upper bound for runs that end with an event.
struct Estimate {
    std::int64_t steps = 0;
    double solve_seconds = 0, draw_seconds = 0;
    double memory = 0, disk = 0;  ///< bytes
};

/// The speed of the solver is measured, by some steps of `simulation` that take about a tenth of a second;
/// the other costs come from rules of thumb (see the source).
Estimate estimate_run(const Scene& scene, const Built<2>& built, Simulation& simulation);

}  // namespace hibi
