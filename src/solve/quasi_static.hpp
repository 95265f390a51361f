#pragma once
#include <optional>
#include <string>

#include "simulation/simulation.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// A load that rises evenly finds the body behind its static state. Both as fractions of the load after
/// `periods` first periods:
///     lag = ratio / (pi N)                                 the load at first break is that much too high
///     swing = exp(-2 pi ratio N) / (2 pi N)                and up to that much too high or too low besides
/// The response of one mode to a ramp. Of a cantilever, at ratios of 0.3 and 1 and 2 to 30 periods, the lag
/// was 1.01 to 1.08 times that with 20 x 10 particles, up to 1.14 times with 10 x 5.
struct RampBias {
    double lag = 0, swing = 0;
};
RampBias ramp_bias(double ratio, double periods);

/// From here on a ramp counts as slow, and what the lag leaves is below 1 % at a ratio of 0.3.
inline constexpr double slow_ramp_periods = 10;

/// Of the first mode, held and driven particles at rest (s). Nothing where a body can move freely, nothing is
/// held, or the run is static.
std::optional<double> first_period(const Built<2>& built, const Simulation& simulation);

/// Up to here a check looks for the first period itself: 7 s of one core (measured, a plate of 80 000).
inline constexpr int most_particles_for_period = 80000;

/// Whether a check leaves it out for the time it would take. Damped by a ratio, a run has found it already.
bool period_takes_too_long(const Simulation& simulation, int most_particles = most_particles_for_period);

/// Damping ratio of a mode of that period; 0 when undamped.
double damping_ratio(const Simulation& simulation, double period);

/// What a load that has risen for `seconds` does to the load at first break, for people; "" where the ramp is
/// slow.
std::string fast_ramp(const std::string& load, double ramp, double seconds, double period, double ratio);

}  // namespace hibi
