#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/difference.hpp"
#include "picture_tests/findings.hpp"
#include "record/difference.hpp"
#include "scene/scene.hpp"

namespace hibi {

struct DiffOptions {
    std::filesystem::path expected, actual;  ///< two pictures or films, folders of them, frames.json, or runs
    std::filesystem::path output = "out/diff";  ///< folder of the pictures and the page
    std::optional<std::filesystem::path> junit{};
    Tolerance pixels{};
    RunTolerance run{};
};

/// Compares two pictures or films, two folders of them, two lists of frames or two runs; writes expected.png,
/// actual.png, heat.png, flicker.apng (of the worst frame), difference.html, and JUnit XML where that is
/// asked for. Throws std::invalid_argument naming the file for what cannot be compared.
Findings diff(const DiffOptions& options);

/// Sets the limits that are given, and leaves the others.
void set_limits(const TestLimits& given, Tolerance& pixels, RunTolerance& run);

}  // namespace hibi
