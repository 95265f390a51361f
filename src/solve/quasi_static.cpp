#include "solve/quasi_static.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/units.hpp"
#include "elasticity/frequency.hpp"
#include "loads/supports.hpp"
#include "scene/build_supports.hpp"

namespace hibi {

RampBias ramp_bias(double ratio, double periods) {
    using std::numbers::pi;
    return {ratio / (pi * periods), std::exp(-2 * pi * ratio * periods) / (2 * pi * periods)};
}

namespace {

bool is_damped_by_ratio(const Simulation& simulation) {
    const auto& damping = simulation.physics().damping;
    return damping && damping->ratio;
}

}  // namespace

bool period_takes_too_long(const Simulation& simulation, int most_particles) {
    return !simulation.physics().statics && !is_damped_by_ratio(simulation) &&
           simulation.particle_count() > most_particles;
}

std::optional<double> first_period(const Built<2>& built, const Simulation& simulation) {
    if (is_damped_by_ratio(simulation))  // found for it already
        return 4 * std::numbers::pi * *simulation.physics().damping->ratio / simulation.damping_rate();
    if (simulation.physics().statics || free_particle(built)) return {};
    try {
        return 2 * std::numbers::pi / first_frequency(built.model, held_or_driven(simulation.particle_count(), simulation.physics()));
    } catch (const std::runtime_error&) {
        return {};  // everything is held, or a part is a mechanism
    }
}

double damping_ratio(const Simulation& simulation, double period) {
    return simulation.damping_rate() * period / (4 * std::numbers::pi);
}

std::string fast_ramp(const std::string& load, double ramp, double seconds, double period, double ratio) {
    const double periods = seconds / period;
    if (periods >= slow_ramp_periods) return "";
    const std::string rises = fmt::format("load \"{}\" rises for {:.2g} first periods (of {})", load, periods,
                                          format_si(period, "s"));
    const std::string way_out =
        fmt::format("ten periods: ramp = {}", format_si(ramp * slow_ramp_periods / periods, "s", 2));
    if (periods < 1) return fmt::format("{}: what breaks is dynamic, not static; {}", rises, way_out);
    const RampBias bias = ramp_bias(ratio, periods);
    return fmt::format(
        "{}: by then it is {:.1f} % above what the body feels, and swings by up to {:.1f} %; {}", rises,
        100 * bias.lag, 100 * bias.swing, way_out);
}

}  // namespace hibi
