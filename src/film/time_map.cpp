#include "film/time_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hibi {
namespace {

/// A piece of the run that is played at one rate.
struct Piece {
    double until = 0;  ///< simulated time at which it ends (s)
    double share = 0;  ///< of the film; only proportions count
};

std::vector<Piece> even(double begin, double end) { return {{end, end > begin ? end - begin : 1}}; }

std::vector<Piece> with_slow_spans(double begin, double end, const std::vector<SlowSpan>& slow) {
    std::vector<double> borders{end};
    for (const SlowSpan& span : slow)
        for (const double t : {span.begin, span.end})
            if (t < end) borders.push_back(t);
    std::ranges::sort(borders);

    std::vector<Piece> pieces;
    double from = begin;
    for (const double until : borders) {
        if (until <= from) continue;
        double rate = 0;  // of the slowest span over this piece; 0: none
        for (const SlowSpan& span : slow)
            if (span.begin <= from && span.end >= until && (rate == 0 || span.rate < rate)) rate = span.rate;
        pieces.push_back({until, (until - from) / (rate > 0 ? rate : 1)});
        from = until;
    }
    return pieces.empty() ? even(begin, end) : pieces;
}

// The film as it is cut when nobody says otherwise: shares of its length.
constexpr double failure_share = 0.40;
constexpr double most_after = 0.25;
// The failure begins this much before first break: a part of its own length, but not less than a part of the
// run, so that a body that breaks in one moment is seen to do so.
constexpr double lead_of_failure = 0.05;
constexpr double least_lead_of_run = 0.0005;

std::vector<Piece> with_emphasis(double begin, double end, const Emphasis& emphasis) {
    const double lead = std::max(lead_of_failure * (emphasis.separation - emphasis.first_break),
                                 least_lead_of_run * (end - begin));
    const double from = std::clamp(emphasis.first_break - lead, begin, end);
    const double until = std::clamp(emphasis.separation, from, end);
    const double failure = until - from;
    if (failure <= 0 || failure >= failure_share * (end - begin)) return even(begin, end);

    const double after = std::min(most_after, failure_share * (end - until) / failure);
    // What leads up to the failure is never slower than the failure itself, which takes the rest.
    const double before = std::min(1 - failure_share - after, (1 - after) * (from - begin) / (until - begin));
    return {{from, before}, {until, 1 - before - after}, {end, after}};
}

}  // namespace

TimeMap::TimeMap(double begin, double end, double duration, const std::vector<SlowSpan>& slow,
                 const std::optional<Emphasis>& emphasis) {
    assert(end >= begin && duration >= 0);
    const std::vector<Piece> pieces = !slow.empty() ? with_slow_spans(begin, end, slow)
                                      : emphasis    ? with_emphasis(begin, end, *emphasis)
                                                    : even(begin, end);
    double sum = 0;
    for (const Piece& piece : pieces) sum += piece.share;
    knots_.emplace_back(0, begin);
    double played = 0;
    for (const Piece& piece : pieces) {
        played += piece.share;
        if (piece.share > 0) knots_.emplace_back(duration * (played / sum), piece.until);
    }
    knots_.back() = {duration, end};  // exactly, whatever the sum was rounded to
}

TimeMap TimeMap::shifted(double offset) const {
    TimeMap map = *this;
    for (auto& [film, simulated] : map.knots_) simulated += offset;
    return map;
}

double TimeMap::simulated(double film) const {
    if (!(film > 0)) return knots_.front().second;
    const auto next = std::ranges::upper_bound(knots_, film, {}, &std::pair<double, double>::first);
    if (next == knots_.end()) return knots_.back().second;
    const auto [f0, t0] = *std::prev(next);
    const auto [f1, t1] = *next;
    return std::min(t1, t0 + (t1 - t0) * ((film - f0) / (f1 - f0)));
}

double TimeMap::film(double simulated) const {
    const auto next = std::ranges::lower_bound(knots_, simulated, {}, &std::pair<double, double>::second);
    if (next == knots_.begin()) return 0;
    if (next == knots_.end()) return duration();
    const auto [f0, t0] = *std::prev(next);
    const auto [f1, t1] = *next;
    return std::min(f1, f0 + (f1 - f0) * ((simulated - t0) / (t1 - t0)));
}

}  // namespace hibi
