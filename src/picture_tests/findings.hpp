#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "picture_tests/frame_difference.hpp"
#include "picture_tests/junit.hpp"
#include "record/difference.hpp"

namespace hibi {

struct DiffOptions;

/// Everything that was found, from which verdict, JSON, page and JUnit are made.
struct Findings {
    std::vector<FrameDifference> frames{};
    const FrameDifference* worst = nullptr;
    std::string other_frames{};  ///< why the frames of two runs are not compared
    std::vector<std::string> not_compared{};  ///< files that are not the same, and have no pixels to compare
    std::optional<RunDifference> run{};
    Sameness pixels = Sameness::identical, physics = Sameness::identical;
    std::string verdict{}, detail{};  ///< detail may be empty

    std::string line() const { return detail.empty() ? verdict : fmt::format("{} ({})", verdict, detail); }
    Sameness all() const { return std::max(pixels, physics); }
};

/// Compares what the options name. Throws std::invalid_argument naming the file for what cannot be compared.
Findings find(const DiffOptions& options);

std::string findings_json(const Findings& findings, const DiffOptions& options);
/// difference.html and the pictures of the worst frame.
void write_findings_page(const Findings& findings, const DiffOptions& options);
std::vector<JunitCase> junit_cases(const Findings& findings, const DiffOptions& options);

}  // namespace hibi
