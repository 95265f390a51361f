#include "report/study.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "base/units.hpp"
#include "image/axis.hpp"
#include "report/place.hpp"

namespace hibi {

namespace {

using Json = nlohmann::ordered_json;

constexpr double most_movement = 0.05;

/// A figure of a finished run; nothing where the event did not happen.
struct Column {
    const char *name, *unit;
    std::function<std::optional<double>(const RunSummary&)> value;
};

std::optional<double> of_event(const std::optional<Event>& event, double Event::*value) {
    return event ? std::optional((*event).*value) : std::nullopt;
}

double solve_seconds(const RunSummary& s) {
    const auto found = s.seconds.find("solve");
    return found == s.seconds.end() ? 0 : found->second;
}

const std::vector<Column>& columns() {
    using S = RunSummary;
    static const std::vector<Column> list{
        {"first_break_time", "s", [](const S& s) { return of_event(s.events.first_break, &Event::time); }},
        {"first_break_load", "N", [](const S& s) { return of_event(s.events.first_break, &Event::load); }},
        {"first_break_displacement", "m",
         [](const S& s) { return of_event(s.events.first_break, &Event::displacement); }},
        {"first_break_x", "m",
         [](const S& s) {
             return s.events.first_break ? std::optional(s.events.first_break->position.x()) : std::nullopt;
         }},
        {"first_break_y", "m",
         [](const S& s) {
             return s.events.first_break ? std::optional(s.events.first_break->position.y()) : std::nullopt;
         }},
        {"peak_load_time", "s", [](const S& s) { return of_event(s.events.peak_load, &Event::time); }},
        {"peak_load", "N", [](const S& s) { return of_event(s.events.peak_load, &Event::load); }},
        {"separation_time", "s", [](const S& s) { return of_event(s.events.separation, &Event::time); }},
        {"separation_load", "N", [](const S& s) { return of_event(s.events.separation, &Event::load); }},
        {"broken", "-", [](const S& s) { return std::optional<double>(s.broken); }},
        {"bonds", "-", [](const S& s) { return std::optional<double>(s.bonds); }},
        {"particles", "-", [](const S& s) { return std::optional<double>(s.particles); }},
        {"steps", "-", [](const S& s) { return std::optional<double>(static_cast<double>(s.steps)); }},
        {"time_step", "s", [](const S& s) { return std::optional(s.time_step); }},
        {"worst_imbalance", "-", [](const S& s) { return std::optional(s.worst_imbalance); }},
        {"solve_seconds", "s", [](const S& s) { return std::optional(solve_seconds(s)); }}};
    return list;
}

const char* status_word(const StudyRun& run) {
    if (run.done()) return run.status == 4 ? "untrusted" : "done";
    return "failed";
}

std::string cell(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

bool has_criteria(const std::vector<StudyRun>& runs) {
    return std::ranges::any_of(runs, [](const StudyRun& r) { return !r.criterion.empty(); });
}

/// Runs that were done, by criterion, in their order.
std::vector<std::pair<std::string, std::vector<const StudyRun*>>> by_criterion(
    const std::vector<StudyRun>& runs) {
    std::vector<std::pair<std::string, std::vector<const StudyRun*>>> groups;
    for (const StudyRun& run : runs) {
        if (!run.done()) continue;
        auto group = std::ranges::find(groups, run.criterion, &decltype(groups)::value_type::first);
        if (group == groups.end()) group = groups.insert(groups.end(), {run.criterion, {}});
        group->second.push_back(&run);
    }
    return groups;
}

double failure_load(const StudyRun& run) {
    return run.summary->events.first_break ? run.summary->events.first_break->load : std::nan("");
}

}  // namespace

std::string StudyRun::label() const {
    std::string text;
    for (const Parameter& p : parameters)
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", p.name, p.text);
    if (!criterion.empty()) text += ", " + criterion;
    return text;
}

std::string study_csv(const std::vector<StudyRun>& runs, const std::string& comment) {
    std::vector<std::string> names, units;
    for (const StudyRun::Parameter& p : runs.at(0).parameters) {
        names.push_back(cell(p.name));
        units.push_back(fmt::format("{} ({})", p.name, p.unit.empty() ? "-" : p.unit));
    }
    const bool criteria = has_criteria(runs);
    for (const char* name : {"criterion", "status"})
        if (criteria || name != std::string("criterion")) names.push_back(name), units.push_back(name);
    for (const Column& c : columns()) {
        names.push_back(c.name);
        units.push_back(fmt::format("{} ({})", c.name, c.unit));
    }
    for (const char* name : {"mode", "folder", "error"}) names.push_back(name), units.push_back(name);
    std::string text = fmt::format("# {}; {}\n{}\n", fmt::join(units, ", "), comment, fmt::join(names, ","));
    for (const StudyRun& run : runs) {
        std::vector<std::string> cells;
        for (const StudyRun::Parameter& p : run.parameters) cells.push_back(fmt::format("{}", p.value));
        if (criteria) cells.push_back(run.criterion);
        cells.push_back(status_word(run));
        for (const Column& c : columns()) {
            const std::optional<double> value = run.summary ? c.value(*run.summary) : std::nullopt;
            cells.push_back(value ? fmt::format("{}", *value) : "");
        }
        for (const std::string* words : {&run.mode, &run.folder, &run.error}) cells.push_back(cell(*words));
        text += fmt::format("{}\n", fmt::join(cells, ","));
    }
    return text;
}

std::string study_json(const std::vector<StudyRun>& runs, const std::string& title,
                       const std::string& command) {
    Json list = Json::array();
    for (const StudyRun& run : runs) {
        Json parameters = Json::object();
        for (const StudyRun::Parameter& p : run.parameters)
            parameters[p.name] = {{"text", p.text}, {"value", p.value}, {"unit", p.unit}};
        Json row{{"parameters", parameters}};
        if (!run.criterion.empty()) row["criterion"] = run.criterion;
        row["status"] = status_word(run);
        for (const Column& c : columns()) {
            const std::optional<double> value = run.summary ? c.value(*run.summary) : std::nullopt;
            row[c.name] = value ? Json(*value) : Json(nullptr);
        }
        row["mode"] = run.mode;
        row["folder"] = run.folder;
        row["error"] = run.error.empty() ? Json(nullptr) : Json(run.error);
        list.push_back(row);
    }
    return Json{{"title", title}, {"version", HIBI_VERSION}, {"command", command}, {"runs", list}}.dump(
               2, ' ', false, Json::error_handler_t::replace) +
           "\n";
}

std::string study_table(const std::vector<StudyRun>& runs) {
    std::vector<std::vector<std::string>> rows;
    std::vector<std::string> head;
    for (const StudyRun::Parameter& p : runs.at(0).parameters) head.push_back(p.name);
    const bool criteria = has_criteria(runs);
    if (criteria) head.push_back("criterion");
    for (const char* name :
         {"particles", "first break", "peak load", "separation", "imbalance", "solve", "breaks"})
        head.push_back(name);
    rows.push_back(head);
    for (const StudyRun& run : runs) {
        std::vector<std::string> row;
        for (const StudyRun::Parameter& p : run.parameters) row.push_back(p.text);
        if (criteria) row.push_back(run.criterion);
        if (run.done()) {
            const RunSummary& s = *run.summary;
            const auto load = [](const std::optional<Event>& e) {
                return e ? format_si(e->load, "N", 4) : "-";
            };
            row.push_back(fmt::format("{}", s.particles));
            row.push_back(load(s.events.first_break));
            const bool held = !s.events.first_break && s.events.peak_load;  // it would have borne more
            row.push_back((held ? "> " : "") + load(s.events.peak_load));
            row.push_back(s.events.separation ? format_si(s.events.separation->time, "s", 4) : "-");
            row.push_back(fmt::format("{:.2g} %{}", 100 * s.worst_imbalance, s.trusted ? "" : " !"));
            row.push_back(format_si(solve_seconds(s), "s"));
            row.push_back(run.mode);
        } else {
            row.push_back("failed: " + run.error);
        }
        rows.push_back(row);
    }
    std::vector<std::size_t> widths;
    for (const auto& row : rows)
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (k == widths.size()) widths.push_back(0);
            if (k + 1 < row.size()) widths[k] = std::max(widths[k], row[k].size());
        }
    std::string text;
    for (const auto& row : rows) {
        std::string line;
        for (std::size_t k = 0; k < row.size(); ++k)
            line += k + 1 < row.size() ? fmt::format("{:<{}}  ", row[k], widths[k]) : row[k];
        text += line + "\n";
    }
    return text;
}

std::optional<Chart> study_chart(const std::vector<StudyRun>& runs) {
    std::vector<std::size_t> varying;
    for (std::size_t k = 0; k < runs.at(0).parameters.size(); ++k) {
        std::set<double> values;
        for (const StudyRun& run : runs) values.insert(run.parameters[k].value);
        if (values.size() > 1) varying.push_back(k);
    }
    const auto done = std::ranges::count_if(runs, &StudyRun::done);
    if (varying.empty() || varying.size() > 2 || done < 2) return {};
    const StudyRun::Parameter& along = runs[0].parameters[varying[0]];
    Chart chart{.x = {along.name, along.unit}, .y = {"Load", "N"}};
    chart.x.from_zero = false;
    const auto line_of = [&](const std::string& label) -> ChartLine& {
        for (ChartLine& line : chart.lines)
            if (line.label == label) return line;
        chart.lines.push_back(
            {.label = label, .colour = static_cast<int>(chart.lines.size()), .points = true});
        return chart.lines.back();
    };
    const auto add = [&](const std::string& label, double x, const std::optional<Event>& event) {
        if (!event) return;
        ChartLine& line = line_of(label);
        line.x.push_back(x);
        line.y.push_back(event->load);
    };
    for (const StudyRun& run : runs) {
        if (!run.done()) continue;
        const double x = run.parameters[varying[0]].value;
        if (varying.size() == 1) {
            add("first break", x, run.summary->events.first_break);
            if (run.summary->events.first_break)  // else it is where the ramp ended
                add("peak load", x, run.summary->events.peak_load);
        } else {
            const StudyRun::Parameter& second = run.parameters[varying[1]];
            add(fmt::format("first break, {} = {}", second.name, second.text), x,
                run.summary->events.first_break);
        }
    }
    // Values in the order of the axis, whatever the order they were asked for.
    for (ChartLine& line : chart.lines) {
        std::vector<std::pair<double, double>> points;
        for (std::size_t k = 0; k < line.x.size(); ++k) points.emplace_back(line.x[k], line.y[k]);
        std::ranges::sort(points);
        for (std::size_t k = 0; k < points.size(); ++k) std::tie(line.x[k], line.y[k]) = points[k];
    }
    if (chart.lines.empty()) return {};
    return chart;
}

std::vector<Chart> convergence_charts(const std::vector<StudyRun>& runs) {
    const StudyRun::Parameter& along = runs.at(0).parameters.at(0);
    ChartAxis x{.title = along.name, .unit = along.unit, .logarithmic = true};
    Chart load{.x = x, .y = {"Load at first break", "N"}};
    Chart cost{.x = x, .y = {.title = "Solver time", .unit = "s", .logarithmic = true}};
    int colour = 0;
    for (const auto& [criterion, group] : by_criterion(runs)) {
        ChartLine loads{.label = criterion, .colour = colour, .points = true}, costs = loads;
        for (const StudyRun* run : group) {
            loads.x.push_back(run->parameters[0].value);
            loads.y.push_back(failure_load(*run));
            costs.x.push_back(run->parameters[0].value);
            costs.y.push_back(solve_seconds(*run->summary));
        }
        load.lines.push_back(loads);
        cost.lines.push_back(costs);
        ++colour;
    }
    load.note = judge_convergence(runs).caption;
    return {load, cost};
}

Convergence judge_convergence(const std::vector<StudyRun>& runs) {
    Convergence result;
    for (const auto& [criterion, group] : by_criterion(runs)) {
        std::vector<const StudyRun*> broken;
        for (const StudyRun* run : group)
            if (run->summary->events.first_break) broken.push_back(run);
        if (broken.size() < 2) continue;
        const StudyRun &finest = *broken.back(), &before = *broken[broken.size() - 2];
        const double moved = failure_load(finest) / failure_load(before) - 1;
        const auto percent = [](double part) { return (part > 0 ? "+" : "") + decimal(100 * part, 1) + " %"; };
        std::string text = fmt::format("{}the load at first break moves by {}",
                                       criterion.empty() ? "" : "With " + criterion + " ", percent(moved));
        double most = std::abs(moved);
        const Events &fine = finest.summary->events, &coarse = before.summary->events;
        if (fine.separation && coarse.separation && fine.peak_load && coarse.peak_load) {
            // Without separation the largest load is that at which the run was over.
            const double peak_moved = fine.peak_load->load / coarse.peak_load->load - 1;
            text += fmt::format(", the peak load by {},", percent(peak_moved));
            most = std::max(most, std::abs(peak_moved));
        }
        const StudyRun::Parameter &p = before.parameters[0], &q = finest.parameters[0];
        text += fmt::format(" from {} = {} to {}", p.name, p.text, q.text);
        text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
        if (most > most_movement) {
            result.warns = true;
            text += ": it does not converge, and is a property of the particles' size, not of the body alone";
        }
        result.caption += (result.caption.empty() ? "" : " ") + text + ".";
    }
    return result;
}

std::string failure_mode(const RunSummary& summary, const Topology& topology,
                         const std::vector<Break>& breaks) {
    if (!summary.events.first_break || breaks.empty()) return "nothing breaks";
    const std::size_t first = std::max<std::size_t>(1, breaks.size() / 20);
    std::size_t stretched = 0;
    for (std::size_t k = 0; k < first; ++k) stretched += breaks[k].strain > 0;
    const double share = static_cast<double>(stretched) / static_cast<double>(first);
    const char* how = share > 2.0 / 3   ? "in tension"
                      : share < 1.0 / 3 ? "in compression"
                                        : "in tension and compression";
    return fmt::format("{} {}", part_of(extent_of(topology), summary.events.first_break->position), how);
}

}  // namespace hibi
