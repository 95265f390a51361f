#include "record/difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/units.hpp"

namespace hibi {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr int curve_moments = 1000;

std::string other_body(const Topology& a, const Topology& b) {
    if (a.dimension != b.dimension) return fmt::format("{} dimensions, not {}", b.dimension, a.dimension);
    if (a.reference_position.size() != b.reference_position.size())
        return fmt::format("{} particles, not {}", b.reference_position.size(), a.reference_position.size());
    for (std::size_t i = 0; i < a.reference_position.size(); ++i)
        if (!((a.reference_position[i] - b.reference_position[i]).norm() <= 1e-9 * a.spacing[i]))
            return fmt::format("particle {} stands elsewhere in the unloaded body", i);
    if (a.first.size() != b.first.size())
        return fmt::format("{} bonds, not {}", b.first.size(), a.first.size());
    if (a.first != b.first || a.second != b.second) return "other particles are bonded";
    return "";
}

bool same_time(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b)); }

/// Displacements of a run at a moment between its states, straight lines between them; with rising times each
/// state is read once.
class Between {
 public:
    explicit Between(const RunReader& run) : run_(run) {}
    std::optional<std::vector<Vec3>> at(double time) {
        const std::vector<StateInfo>& states = run_.states();
        if (time > states.back().time && !same_time(time, states.back().time)) return {};
        int k = 0;
        while (k + 2 < static_cast<int>(states.size()) && states[k + 1].time < time) ++k;
        const int last = std::min<int>(k + 1, static_cast<int>(states.size()) - 1);
        if (k != low_index_) {
            low_ = k == high_index_ ? std::move(high_) : run_.read(k).displacement;
            high_ = run_.read(last).displacement;
            low_index_ = k, high_index_ = last;
        }
        const double span = states[last].time - states[k].time;
        const double share = span > 0 ? std::clamp((time - states[k].time) / span, 0.0, 1.0) : 0;
        std::vector<Vec3> result(low_.size());
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = low_[i] + share * (high_[i] - low_[i]);
        return result;
    }

 private:
    const RunReader& run_;
    int low_index_ = -1, high_index_ = -1;
    std::vector<Vec3> low_, high_;
};

void compare_moment(const Topology& topology, double time, const std::vector<Vec3>& a,
                    const std::vector<Vec3>& b, const RunTolerance& tolerance, PositionsDifference& d) {
    PositionsDifference::Place worst;
    for (std::size_t i = 0; i < a.size(); ++i) {
        double distance = (a[i] - b[i]).norm();
        if (std::isnan(distance)) {
            const bool both = !a[i].allFinite() && !b[i].allFinite();
            distance = both ? 0 : infinity;
        }
        const double spacings = distance / topology.spacing[i];
        if (spacings > worst.spacings)
            worst = {distance, spacings, time, static_cast<int>(i), topology.reference_position[i]};
    }
    ++d.compared;
    if (worst.spacings > (d.largest ? d.largest->spacings : 0)) d.largest = worst;
    if (!d.first_beyond && worst.spacings > tolerance.position) d.first_beyond = worst;
}

PositionsDifference compare_positions(const RunReader& a, const RunReader& b, const RunTolerance& tolerance) {
    PositionsDifference d;
    d.interpolated = !same_time(a.summary().time_step, b.summary().time_step);
    Between between(b);
    std::size_t other = 0;
    for (std::size_t k = 0; k < a.states().size(); ++k) {
        const StateInfo& state = a.states()[k];
        std::optional<std::vector<Vec3>> actual;
        if (d.interpolated) {
            actual = between.at(state.time);
        } else {
            while (other < b.states().size() && b.states()[other].step < state.step) ++other;
            if (other < b.states().size() && b.states()[other].step == state.step)
                actual = b.read(static_cast<int>(other)).displacement;
        }
        if (actual)
            compare_moment(a.topology(), state.time, a.read(static_cast<int>(k)).displacement, *actual,
                           tolerance, d);
    }
    return d;
}

BondsDifference compare_bonds(const RunReader& a, const RunReader& b, const RunTolerance& tolerance) {
    BondsDifference d;
    const double step = a.summary().time_step;
    for (std::size_t k = 0; k < a.broken_at().size(); ++k) {
        const double expected = a.broken_at()[k], actual = b.broken_at()[k];
        const bool broke = std::isfinite(expected), breaks = std::isfinite(actual);
        d.expected_broken += broke;
        d.actual_broken += breaks;
        if (expected == actual) continue;
        BondChange change{static_cast<int>(k), a.topology().first[k], a.topology().second[k], expected,
                          actual};
        if (broke && breaks && step > 0) {
            change.steps = std::llround((actual - expected) / step);
            if (std::abs(actual - expected) <= (tolerance.break_steps + 0.5) * step) {
                ++d.other_step;
                continue;
            }
        }
        ++d.changed;
        if (!d.first || change.time() < d.first->time()) d.first = change;
    }
    return d;
}

double load_between(const History& history, std::size_t& k, double time) {
    const std::vector<HistoryRow>& rows = history.rows;
    while (k + 2 < rows.size() && rows[k + 1].time < time) ++k;
    if (k + 1 >= rows.size()) return rows.back().load;
    const HistoryRow &a = rows[k], &b = rows[k + 1];
    return a.load + std::clamp((time - a.time) / (b.time - a.time), 0.0, 1.0) * (b.load - a.load);
}

std::optional<double> load_of(const std::optional<Event>& event) {
    return event ? std::optional(event->load) : std::nullopt;
}

std::optional<CurveDifference> compare_curves(const RunReader& a, const RunReader& b,
                                              const RunTolerance& tolerance) {
    if (a.topology().loads.empty() && b.topology().loads.empty()) return {};
    CurveDifference d;
    const Events &expected = a.summary().events, &actual = b.summary().events;
    d.peak = {load_of(expected.peak_load), load_of(actual.peak_load)};
    d.first_break = {load_of(expected.first_break), load_of(actual.first_break)};
    for (const HistoryRow& row : a.history().rows) d.scale = std::max(d.scale, std::abs(row.load));
    if (a.history().rows.empty() || b.history().rows.empty()) return d;
    const double end = std::min(a.history().rows.back().time, b.history().rows.back().time);
    std::size_t ka = 0, kb = 0;
    for (int m = 0; m <= curve_moments; ++m) {
        const double time = end * m / curve_moments;
        const double off =
            std::abs(load_between(b.history(), kb, time) - load_between(a.history(), ka, time));
        if (off > d.largest) d.largest = off, d.largest_time = time;
        if (!d.first_beyond && !(off <= tolerance.load * d.scale)) d.first_beyond = time;
    }
    return d;
}

}  // namespace

double BondChange::time() const { return std::min(expected, actual); }

bool CurveDifference::Pair::same(double limit) const {
    if (expected.has_value() != actual.has_value()) return false;
    return !expected || std::abs(*expected - *actual) <= limit;
}

RunDifference difference(const RunReader& a, const RunReader& b, const RunTolerance& tolerance) {
    RunDifference d;
    d.other_body = other_body(a.topology(), b.topology());
    d.expected_end = a.summary().end_time;
    d.actual_end = b.summary().end_time;
    d.curve = compare_curves(a, b, tolerance);
    const double step = a.summary().time_step;
    d.same = std::abs(d.expected_end - d.actual_end) <= (tolerance.break_steps + 0.5) * step;
    d.identical = d.expected_end == d.actual_end;
    if (d.curve) {
        const double limit = tolerance.load * d.curve->scale;
        d.same =
            d.same && d.curve->peak.same(limit) && d.curve->first_break.same(limit) && !d.curve->first_beyond;
        d.identical =
            d.identical && d.curve->peak.same(0) && d.curve->first_break.same(0) && d.curve->largest == 0;
    }
    if (!d.other_body.empty()) {
        d.same = d.identical = false;
        return d;
    }
    d.bonds = compare_bonds(a, b, tolerance);
    d.positions = compare_positions(a, b, tolerance);
    d.same = d.same && d.bonds.changed == 0 && !d.positions.first_beyond;
    d.identical = d.identical && d.bonds.changed == 0 && d.bonds.other_step == 0 && !d.positions.largest &&
                  !d.positions.interpolated;
    return d;
}

std::string describe(const BondChange& change) {
    const std::string bond = fmt::format("bond {}-{}", change.first, change.second);
    if (!std::isfinite(change.expected)) return bond + " broke, which it did not";
    if (!std::isfinite(change.actual)) return bond + " did not break";
    const std::int64_t steps = std::abs(change.steps);
    return fmt::format("{} broke {} step{} {}", bond, steps, steps == 1 ? "" : "s",
                       change.steps < 0 ? "earlier" : "later");
}

std::string relative_change(const CurveDifference::Pair& pair) {
    if (!pair.expected && !pair.actual) return "none";
    if (!pair.actual) return "none, expected one";
    if (!pair.expected) return "one, expected none";
    if (*pair.expected == 0) return format_si(*pair.actual, "N") + " in place of 0 N";
    const double change = 100 * (*pair.actual / *pair.expected - 1);
    return fmt::format("{:+.{}f} %", change, std::abs(change) < 1 ? 2 : 1);
}

std::string physics_verdict(const RunDifference& d, const RunTolerance& tolerance) {
    std::string loads;
    if (d.curve) {
        const double limit = tolerance.load * d.curve->scale;
        if (!d.curve->first_break.same(limit))
            loads += "; load at first break " + relative_change(d.curve->first_break);
        if (!d.curve->peak.same(limit)) loads += "; peak load " + relative_change(d.curve->peak);
    }
    if (!d.other_body.empty()) return "another body: " + d.other_body + loads;
    // Of what happens at one moment the first named says most.
    double first = infinity;
    std::string what;
    const auto consider = [&](double time, const std::string& words) {
        if (time < first) first = time, what = words;
    };
    if (const auto& bond = d.bonds.first) consider(bond->time(), describe(*bond));
    if (const auto& place = d.positions.first_beyond)
        consider(place->time, fmt::format("particle {} is off by {} ({:.2g} spacings)", place->particle,
                                          format_si(place->distance, "m"), place->spacings));
    if (d.curve && d.curve->first_beyond)
        consider(*d.curve->first_beyond,
                 fmt::format("the load is off, by {} at most", format_si(d.curve->largest, "N")));
    if (what.empty() && !loads.empty()) return "physics changed: " + loads.substr(2);
    if (what.empty())
        consider(std::min(d.expected_end, d.actual_end),
                 fmt::format("it ends at {}, not at {}", format_si(d.actual_end, "s", 4),
                             format_si(d.expected_end, "s", 4)));
    return fmt::format("physics changed first at t = {}: {}{}", format_si(first, "s", 4), what, loads);
}

}  // namespace hibi
