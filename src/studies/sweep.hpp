#pragma once
#include "studies/study_runs.hpp"

namespace hibi {

struct SweepOptions {
    std::filesystem::path scene;
    std::vector<std::string> grid{};  ///< as given: name=value,value
    StudyOptions study{};             ///< folder empty: out/<scene name>_sweep
    RendererOptions renderer{};
};

struct SweepResult {
    std::filesystem::path folder;
    std::vector<StudyRun> runs;
    std::string json;      ///< of sweep.json
    bool plotted = false;  ///< a plot needs one or two parameters that vary, and two runs that succeed
};

/// All combinations of parameters: sweep.csv, sweep.json, sheet.png, plot.png and plot.svg.
SweepResult run_sweep(SweepOptions options);

}  // namespace hibi
