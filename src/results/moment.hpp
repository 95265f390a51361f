#pragma once
#include <optional>
#include <string>

#include "base/vec.hpp"

namespace hibi {

enum class EventName { start, first_break, peak_load, separation, end };
const char* to_string(EventName name);
std::optional<EventName> event_from(const std::string& text);

/// A time, or an event plus an offset.
struct Moment {
    std::optional<EventName> event{};
    double offset = 0;  ///< (s); the time itself where there is no event
};

/// What was true when something happened. SI; direction and sign of load and displacement as in Load.
struct Event {
    double time = 0, load = 0, displacement = 0;
    Vec3 position = Vec3::Zero();  ///< of the bond concerned (reference configuration); zero where there is none

    template <class Self, class Visit>
    static void each_field(Self& self, Visit&& visit) {
        visit("time", self.time);
        visit("load", self.load);
        visit("displacement", self.displacement);
        visit("position", self.position);
    }
};

/// The events of a run; empty: has not happened (yet).
struct Events {
    std::optional<Event> first_break{}, peak_load{}, separation{};
    double end = 0;  ///< time of the last step (s)

    template <class Self, class Visit>
    static void each_field(Self& self, Visit&& visit) {
        visit("first_break", self.first_break);
        visit("peak_load", self.peak_load);
        visit("separation", self.separation);
        visit("end", self.end);
    }

    /// Time of a moment, or nothing if its event has not happened.
    std::optional<double> time_of(const Moment& moment) const;
};

}  // namespace hibi
