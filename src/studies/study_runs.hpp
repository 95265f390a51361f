#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "record/provenance.hpp"
#include "render/renderer.hpp"
#include "report/study.hpp"
#include "scene/read.hpp"

namespace hibi {

/// Parameters with several values each, in the order given: -p spacing=2m,1m -p height=5m,10m.
using Grid = std::vector<std::pair<std::string, std::vector<std::string>>>;

/// Splits at commas that stand in no brackets. Throws std::invalid_argument for an empty value.
std::vector<std::string> split_values(const std::string& text);

/// name=value,value ... Throws std::invalid_argument.
Grid read_grid(const std::vector<std::string>& texts);

/// One run of a study, before it is run.
struct StudyPoint {
    Overrides overrides;
    std::filesystem::path scene;  ///< file
    bool folded = false;          ///< the overrides stand in the scene's file already
    std::string name;             ///< of its folder: "spacing=2m,height=5m"
    std::string criterion{};      ///< see StudyRun
};

/// All combinations, the last parameter varying fastest; names are those of folders.
std::vector<StudyPoint> grid_points(const std::filesystem::path& scene, const Grid& grid);

/// Each combination of values once, in the order given, however they are written: "0.4" and "400 ms" of a
/// time are the same point, under the same name. Combinations that make no scene stay as they are.
std::vector<StudyPoint> distinct_points(const std::vector<StudyPoint>& points);

struct StudyOptions {
    std::filesystem::path folder;
    int jobs = 0;           ///< runs at once; 0: one per core
    bool pictures = false;  ///< film, figures and report of each run
    bool force = false;     ///< run also what is there already
    bool quiet = false;
};

/// Runs each point in a process of its own, with one thread, into its folder below options.folder. A finished
/// run of the same scene by the same program is kept. One that fails is noted and stops none of the others.
/// Throws SceneErrors before anything is run where a scene is wrong.
std::vector<StudyRun> run_study(const std::vector<StudyPoint>& points, const StudyOptions& options);

/// 0 where all runs are done, 4 where an energy balance is off, 1 where a run failed.
int study_status(const std::vector<StudyRun>& runs);

/// A folder that holds other things than studies and runs is refused (std::runtime_error).
void require_study_folder(const std::filesystem::path& folder, bool force);

/// sheet.png: each run at its most telling moment, labelled by its parameters.
void write_sheet(const std::vector<StudyRun>& runs, const std::filesystem::path& folder,
                 const std::string& title, const RendererOptions& renderer, const Provenance& provenance);

}  // namespace hibi
