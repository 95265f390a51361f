#include "solve/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "base/units.hpp"
#include "solve/quasi_static.hpp"

namespace hibi {

namespace {

/// Of bonds; the elastic law is linear.
constexpr double most_strain = 0.5;

/// A linear law does not know that nothing stretches so far.
void warn_of_strain(double largest_strain, std::vector<std::string>& list) {
    if (largest_strain <= most_strain) return;
    list.push_back(fmt::format(
        "intact bonds were stretched or squeezed by as much as {:.3g} % of their length: more than a "
        "linear law can stand for; give the material a break_strain, or lower the load",
        100 * largest_strain));
}

/// Damped by a ratio, a run is meant to be slow: what its ramps do to the load at first break.
void warn_of_fast_ramps(const Scene& scene, const RunSummary& summary, double damping_rate,
                        std::vector<std::string>& list) {
    if (!scene.damping || !scene.damping->damping.ratio || !summary.events.first_break) return;
    const double ratio = *scene.damping->damping.ratio, period = 4 * std::numbers::pi * ratio / damping_rate;
    for (const LoadSpec& load : scene.loads) {
        if (load.kind == Load::Kind::velocity || load.ramp == 0) continue;
        const double rises = std::min(load.ramp, summary.events.first_break->time);
        const std::string text = fast_ramp(load.name, load.ramp, rises, period, ratio);
        if (!text.empty()) list.push_back(text);
    }
}

}  // namespace

std::vector<std::string> run_warnings(const Scene& scene, const Simulation& simulation,
                                      const RunSummary& summary, double damping_rate, double largest_strain) {
    std::vector<std::string> list;
    if (simulation.instability()) list.push_back(*simulation.instability());
    if (simulation.collapse()) list.push_back(*simulation.collapse());
    if (simulation.can_break() && !summary.events.first_break)
        list.push_back(
            fmt::format("nothing broke: in the end the most strained bond is at {:.2g} % of its "
                        "limit; raise the load, or max_time",
                        100 * simulation.closest_to_breaking()));
    const Events& events = summary.events;
    if (scene.run.until && scene.run.until->event && !summary.stopped) {
        const EventName event = *scene.run.until->event;
        const bool seen = (event == EventName::first_break && events.first_break) ||
                          (event == EventName::peak_load && summary.end_time < scene.run.max_time) ||
                          (event == EventName::separation && events.separation);
        if (!seen) {
            list.push_back(fmt::format("{} was not reached before max_time = {}", to_string(event),
                                       format_si(scene.run.max_time, "s")));
            if (event == EventName::separation && events.first_break) {
                list.back() +=
                    ": what is loaded still hangs together with what is held, by one bond at least; raise "
                    "the "
                    "load or max_time, or let [run] until be another moment";
                if (scene.damping && (!scene.damping->until || !scene.damping->until->event ||
                                      scene.damping->until->event == EventName::separation))
                    list.back() += "; damping holds back what falls: [damping] until = \"first_break\"";
            }
        }
    }
    if (!summary.trusted)
        list.push_back(
            fmt::format("the energy balance is off by {:.2g} %: do not trust this run; {} may help",
                        100 * summary.worst_imbalance,
                        scene.run.statics ? "more load_steps" : "a smaller time_step_factor"));
    warn_of_strain(largest_strain, list);
    warn_of_fast_ramps(scene, summary, damping_rate, list);
    return list;
}

}  // namespace hibi
