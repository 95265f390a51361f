#include "results/moment.hpp"

namespace hibi {

const char* to_string(EventName name) {
    switch (name) {
        case EventName::start:
            return "start";
        case EventName::first_break:
            return "first_break";
        case EventName::peak_load:
            return "peak_load";
        case EventName::separation:
            return "separation";
        case EventName::end:
            return "end";
    }
    return "";
}

std::optional<EventName> event_from(const std::string& text) {
    for (const EventName name : {EventName::start, EventName::first_break, EventName::peak_load,
                                 EventName::separation, EventName::end})
        if (text == to_string(name)) return name;
    return {};
}

std::optional<double> Events::time_of(const Moment& moment) const {
    if (!moment.event) return moment.offset;
    const auto after = [&](const std::optional<Event>& event) -> std::optional<double> {
        if (!event) return {};
        return event->time + moment.offset;
    };
    switch (*moment.event) {
        case EventName::start:
            return moment.offset;
        case EventName::first_break:
            return after(first_break);
        case EventName::peak_load:
            return after(peak_load);
        case EventName::separation:
            return after(separation);
        case EventName::end:
            return end + moment.offset;
    }
    return {};
}

}  // namespace hibi
