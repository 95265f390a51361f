#pragma once
#include <optional>
#include <string>
#include <vector>

#include "image/chart.hpp"
#include "record/run_folder.hpp"

namespace hibi {

/// One run of several that differ in their parameters.
struct StudyRun {
    struct Parameter {
        std::string name, text;
        double value = 0;  ///< SI
        std::string unit;  ///< SI symbol
    };
    std::vector<Parameter> parameters;
    std::string criterion{};  ///< "fixed strain" or "fracture energy" where a study has both; else empty
    std::string folder;
    int status = 0;       ///< exit status of `hibi run`; 4: its energy balance is off
    std::string error{};  ///< why it failed, in one line
    bool kept = false;    ///< it was there already
    std::optional<RunSummary> summary{};
    std::string mode{};  ///< where and how it began to break, in words

    bool done() const { return summary.has_value(); }
    std::string label() const;  ///< "spacing = 0.5 m, ..."
};

/// All figures as CSV (a commented line with units first, which ends with `comment`), as JSON, and the chief
/// ones as a table for a terminal. SI units in CSV and JSON.
std::string study_csv(const std::vector<StudyRun>& runs, const std::string& comment);
std::string study_json(const std::vector<StudyRun>& runs, const std::string& title,
                       const std::string& command);
std::string study_table(const std::vector<StudyRun>& runs);

/// Load at first break and peak load over the first parameter that varies, a line for each value of a second
/// one (then first break alone). Nothing where fewer than two runs were done, or more parameters vary.
std::optional<Chart> study_chart(const std::vector<StudyRun>& runs);

/// Of runs at several resolutions, from coarse to fine: failure load, and cost, over the first parameter. A
/// line per criterion.
std::vector<Chart> convergence_charts(const std::vector<StudyRun>& runs);

/// How much the failure load moved between the two finest runs of each criterion, and a warning where that is
/// more than 5 %.
struct Convergence {
    std::string caption;
    bool warns = false;
};
Convergence judge_convergence(const std::vector<StudyRun>& runs);

/// Place of the first break in the body, and whether bonds break in tension or compression, from the first
/// twentieth of the breaks.
std::string failure_mode(const RunSummary& summary, const Topology& topology,
                         const std::vector<Break>& breaks);

}  // namespace hibi
