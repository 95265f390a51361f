#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hibi {

/// A span of slow motion, resolved to times. rate is relative to the rest of the film.
struct SlowSpan {
    double begin = 0, end = 0;  ///< simulated time (s)
    double rate = 1;
};

/// The moments that a default film emphasises. Times in s.
struct Emphasis {
    double first_break = 0, separation = 0;
};

/// Film time -> simulated time: piecewise linear and never falling. Built once, from the end of the run.
class TimeMap {
 public:
    /// Slow spans are played at their rate relative to the rest. Without any, and with an emphasis, the span
    /// from just before first break to separation fills at least a third of the film.
    TimeMap(double begin, double end, double duration, const std::vector<SlowSpan>& slow,
            const std::optional<Emphasis>& emphasis);

    /// The same map for a run whose clock differs by `offset` (s).
    TimeMap shifted(double offset) const;

    double simulated(double film) const;  ///< (s)
    double film(double simulated) const;  ///< inverse; the earliest film time where it is not unique
    double duration() const { return knots_.back().first; }
    const std::vector<std::pair<double, double>>& knots() const { return knots_; }  ///< film, simulated

 private:
    std::vector<std::pair<double, double>> knots_;
};

}  // namespace hibi
