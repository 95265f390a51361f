#pragma once
#include "studies/study_runs.hpp"

namespace hibi {

struct ConvergeOptions {
    std::filesystem::path scene;
    std::vector<std::string> grid{};  ///< one parameter with two values or more
    bool both = true;                 ///< also with the other criterion, fixed strain or fracture energy
    bool film = true;                 ///< side by side
    StudyOptions study{};             ///< folder empty: out/<scene name>_converge
    RendererOptions renderer{};
};

struct ConvergeResult {
    std::vector<StudyRun> runs;
    std::string json;  ///< of converge.json
    Convergence verdict;
};

/// The same experiment at several resolutions: converge.csv, converge.json, plot.png, plot.svg, sheet.png,
/// caption.md and movie.mp4.
ConvergeResult run_convergence(ConvergeOptions options);

/// The scene with the other criterion in every material that breaks: break_strain instead of fracture_energy
/// or the other way round, such that at the given spacing (m) both give the bonds of nearest neighbours the
/// same limit.
Scene with_other_criterion(Scene scene, double spacing);

}  // namespace hibi
