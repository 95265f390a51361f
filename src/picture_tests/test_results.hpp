#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/difference.hpp"
#include "picture_tests/junit.hpp"
#include "picture_tests/reference.hpp"
#include "record/difference.hpp"
#include "scene/read.hpp"

namespace hibi {

/// One moment beside its reference.
struct MomentResult {
    std::string moment;
    Sameness sameness = Sameness::identical;
    PixelDifference pixels{};
    std::string complaint{};       ///< why it fails; empty: it passes
    std::filesystem::path page{};  ///< of a failure; empty: none
};

struct SceneResult {
    std::filesystem::path file;
    std::string name;  ///< of its folders
    Overrides overrides{};
    Scene scene{};
    Tolerance pixels{};
    RunTolerance run{};
    std::optional<Reference> reference{};
    std::string error{};      ///< the run failed, and why
    std::string complaint{};  ///< why it fails beyond single moments
    std::string physics{};    ///< what changed; empty: nothing
    bool exact = false;
    std::vector<MomentResult> moments{};
    std::vector<std::string> updates{};  ///< what was written
    double seconds = 0;

    bool passes() const {
        return error.empty() && complaint.empty() && physics.empty() &&
               std::ranges::all_of(moments, [](const MomentResult& m) { return m.complaint.empty(); });
    }
    Sameness sameness() const {
        Sameness worst = Sameness::identical;
        for (const MomentResult& m : moments) worst = std::max(worst, m.sameness);
        return worst;
    }
};

/// A line for each scene with what does not hold, and how many pass.
std::string results_text(const std::vector<SceneResult>& results);
std::string results_json(const std::vector<SceneResult>& results);
std::vector<JunitCase> junit_cases(const std::vector<SceneResult>& results);
/// Exit status: 0 where all pass, 3 where one differs or has no reference, 1 where a run failed.
int test_status(const std::vector<SceneResult>& results);

}  // namespace hibi
