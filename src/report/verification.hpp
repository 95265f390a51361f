#pragma once
#include <optional>
#include <string>
#include <vector>

#include "image/chart.hpp"
#include "image/figure.hpp"
#include "record/provenance.hpp"

namespace hibi {

/// One case of `hibi verify` at one resolution: what was measured, against what, and what it cost.
struct VerifyRow {
    std::string id, title, group;  ///< of the case; the group is the chart it is drawn in
    std::string variant;           ///< "default" or "thesis"
    std::string scene;             ///< built-in scene that says it
    std::string parameter;         ///< that is refined: "rows", "factor", ...
    double resolution = 0;         ///< its value
    double spacing = 0;            ///< of the particles (m), or whatever the error shrinks with
    int particles = 0;
    std::string method = "explicit";  ///< or "static"
    std::int64_t steps = 0;           ///< in time, or of the load
    std::string quantity, unit;       ///< what is measured; unit: SI symbol
    double measured = 0, reference = 0;
    double error = 0;              ///< relative to the reference, or as the case says; never negative
    std::string reference_text{};  ///< where the reference is from
    std::optional<double> goal{};  ///< the largest error that passes
    double seconds = 0, solve_seconds = 0, cpu_seconds = 0;  ///< whole run; its steps alone; all threads
    std::string failure{};                                   ///< why there is no result, in one line

    /// Nothing where there is no goal.
    std::optional<bool> pass() const;
    /// Of an explicit run; 0 for a static one, whose steps are another thing.
    double particle_steps_per_second() const;
};

/// Slope of log error over log spacing by least squares, for one case and variant: 2 where halving the
/// spacing quarters the error. Nothing with fewer than two resolutions, or where every error is rounding
/// alone.
std::optional<double> observed_order(const std::vector<VerifyRow>& rows, const std::string& id,
                                     const std::string& variant);

/// How the runs were timed.
struct VerifyConditions {
    int threads = 1;
    double seconds = 0;  ///< of the whole command
    bool quick = false;
};

std::string verification_table(const std::vector<VerifyRow>& rows);
/// A list with one object per row.
std::string verification_json(const std::vector<VerifyRow>& rows);
std::string verification_csv(const std::vector<VerifyRow>& rows, const std::string& comment);
/// "all 17 goals reached" or which were missed.
std::string verification_verdict(const std::vector<VerifyRow>& rows);

/// Error over the time it takes, both logarithmic: a chart per group, a line per case and variant, the
/// thesis's dashed.
std::vector<Chart> speed_charts(const std::vector<VerifyRow>& rows);

/// One offline HTML page: verdict, charts, table, conditions, command.
std::string verification_page(const std::vector<VerifyRow>& rows, const VerifyConditions& conditions,
                              const Provenance& provenance);

}  // namespace hibi
