#include "app/run_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <thread>

#include "base/profile.hpp"
#include "base/units.hpp"
#include "report/place.hpp"

namespace hibi {

namespace {

std::string event_line(const char* name, const std::optional<Event>& event, bool loaded, bool with_place) {
    if (!event) return fmt::format("{:<16} -\n", name);
    std::string line = fmt::format("{:<16} t = {:<10}", name, format_si(event->time, "s", 4));
    if (loaded)
        line += fmt::format(" load {:<10} displacement {}", format_si(event->load, "N", 4),
                            format_si(event->displacement, "m"));
    if (with_place) line += fmt::format("  at {}", place_text(event->position));
    return line + "\n";
}

}  // namespace

std::string results_text(const RunSummary& s, const std::string& made, bool pictures) {
    std::string text;
    text += event_line("first break", s.events.first_break, s.events.peak_load.has_value(), true);
    text += event_line("peak load", s.events.peak_load, true, false);
    // As large as the scene made it, then; no strength of the body.
    if (s.events.peak_load && !s.events.separation && s.events.peak_load->time > s.end_time - 2 * s.time_step)
        text.insert(text.size() - 1, "  still rising at the end");
    text += event_line("separation", s.events.separation, true, false);
    text += fmt::format("{:<16} {} of {}, in {} steps of {}\n", "broken bonds", s.broken, s.bonds, s.steps,
                        format_si(s.time_step, "s"));
    if (s.crack.tip)
        text += fmt::format("{:<16} {} long, fastest {}; {} fragments, the largest {}, debris {}\n", "cracks",
                            format_si(s.crack.length, "m"), format_si(s.top_crack_speed, "m/s"),
                            s.fragments.count, format_si(1000 * s.fragments.largest, "g"),
                            format_si(1000 * s.fragments.debris, "g"));
    text += fmt::format("{:<16} {:.2g} up to first break, {:.2g} to the end: {}\n", "energy imbalance",
                        s.imbalance_at_first_break, s.worst_imbalance, s.trusted ? "trusted" : "NOT TRUSTED");
    text += fmt::format("{:<16} solve {:.2f}, draw {:.1f}, all {:.1f}\n", "seconds", s.seconds.at("solve"),
                        pictures ? s.seconds.at("draw") : 0.0, s.seconds.at("total"));
    text += fmt::format("{:<16} {}\n", pictures ? "pictures" : "states", made);
    return text;
}

std::string profile_text(const RunSummary& s, bool drawn) {
    std::string text;
    if (const auto run = s.profile.find("run"); run != s.profile.end())
        text += "\n" + profile_table("run", run->second, s.seconds.at("setup") + s.seconds.at("solve"));
    if (const auto draw = s.profile.find("draw"); drawn && draw != s.profile.end()) {
        const double wall = s.seconds.at("draw"), processor = s.seconds.at("draw_processor");
        text += "\n" + profile_table("draw", draw->second, wall);
        const double frames = std::max(1, s.frames);
        const unsigned cores = std::thread::hardware_concurrency();
        text += fmt::format(
            "{} frames of {:.1f} ms, {:.1f} ms of processor time each: {:.0f} % of {} cores\n", s.frames,
            1000 * wall / frames, 1000 * processor / frames, 100 * processor / (wall * cores), cores);
    }
    return text;
}

}  // namespace hibi
