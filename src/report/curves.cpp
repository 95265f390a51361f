#include "report/curves.hpp"

#include <algorithm>
#include <cmath>

namespace hibi {

namespace {

/// Energies that stay below this share of the largest are left out of the chart.
constexpr double least_share = 1e-3;

struct Named {
    const char *label, *in_a_row;
    const std::optional<Event>* event;
};

std::array<Named, 3> named_events(const Events& events) {
    return {{{"First break", "first break", &events.first_break},
             {"Peak load", "peak load", &events.peak_load},
             {"Separation", "separation", &events.separation}}};
}

/// Fragments in free flight would dwarf what happened before.
bool counts(const HistoryRow& row, const Events& events) {
    return !events.separation || row.time <= events.separation->time;
}

/// Marks of the events, those at the same moment as one.
template <class Place>
std::vector<ChartMark> marks_of(const Events& events, Place&& place) {
    std::vector<ChartMark> marks;
    std::vector<double> times;
    for (const auto& [label, in_a_row, event] : named_events(events)) {
        if (!*event) continue;
        const auto same = std::ranges::find(times, (*event)->time);
        if (same != times.end()) {
            marks[static_cast<std::size_t>(same - times.begin())].label += std::string(", ") + in_a_row;
            continue;
        }
        times.push_back((*event)->time);
        marks.push_back(place(**event));
        marks.back().label = label;
    }
    return marks;
}

Chart load_chart(const History& history, const Events& events) {
    Chart chart{.title = {}, .x = {"Displacement", "m"}, .y = {"Load", "N"}, .lines = {{.label = "Load"}}};
    const auto add = [&chart](double displacement, double load) {
        chart.lines[0].x.push_back(displacement);
        chart.lines[0].y.push_back(load);
    };
    for (const HistoryRow& row : history.rows) {
        if (!counts(row, events)) break;
        // A load that ends with the separation is gone in the row of that time: it falls there, not on the way.
        if (const auto& last = events.separation; last && last->time == row.time && last->load != row.load)
            add(last->displacement, last->load);
        add(row.displacement, row.load);
    }
    chart.marks = marks_of(events, [](const Event& e) { return ChartMark{e.displacement, e.load, {}}; });
    return chart;
}

Chart energy_chart(const History& history, const Events& events) {
    Chart chart{.title = {}, .x = {"Time", "s"}, .y = {"Energy", "J"}};
    const std::array<std::pair<const char*, double HistoryRow::*>, 6> kinds{
        {{"work", &HistoryRow::work},
         {"elastic", &HistoryRow::elastic},
         {"kinetic", &HistoryRow::kinetic},
         {"released", &HistoryRow::released},
         {"damped", &HistoryRow::damped},
         {"contact", &HistoryRow::contact}}};
    double largest = 0;
    const auto size_of = [&](double HistoryRow::*kind) {
        double size = 0;
        for (const HistoryRow& row : history.rows)
            if (counts(row, events)) size = std::max(size, std::abs(row.*kind));
        return size;
    };
    for (const auto& [label, kind] : kinds) largest = std::max(largest, size_of(kind));
    int colour = 0;
    for (const auto& [label, kind] : kinds) {
        const int own = colour++;
        if (!(size_of(kind) > least_share * largest)) continue;
        ChartLine line{.label = label, .colour = own, .dashed = kind == &HistoryRow::work};
        for (const HistoryRow& row : history.rows) {
            if (!counts(row, events)) break;
            line.x.push_back(row.time);
            line.y.push_back(row.*kind);
        }
        chart.lines.push_back(std::move(line));
    }
    chart.marks = marks_of(events, [](const Event& e) { return ChartMark{e.time, {}, {}}; });
    return chart;
}

}  // namespace

std::vector<Chart> run_charts(const History& history, const Events& events) {
    std::vector<Chart> charts;
    if (history.rows.size() < 2) return charts;
    if (!history.load_names.empty()) charts.push_back(load_chart(history, events));
    charts.push_back(energy_chart(history, events));
    return charts;
}

}  // namespace hibi
