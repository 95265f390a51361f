#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/difference.hpp"
#include "record/difference.hpp"
#include "report/difference_page.hpp"
#include "scene/scene.hpp"

namespace hibi {

struct DiffOptions {
    std::filesystem::path expected, actual;  ///< two pictures or films, folders of them, frames.json, or runs
    std::filesystem::path output = "out/diff";  ///< folder of the pictures and the page
    std::optional<std::filesystem::path> junit{};
    bool json = false;  ///< print JSON in place of the verdict
    Tolerance pixels{};
    RunTolerance run{};
};

/// `hibi diff`: compares two pictures or films, two folders of them, two lists of frames or two runs; writes
/// expected.png, actual.png, heat.png, flicker.apng (of the worst frame) and difference.html; prints the
/// verdict. Returns 0 where both are the same, 3 where not. Throws std::invalid_argument naming the file for
/// what cannot be compared.
int diff_command(const DiffOptions& options);

/// Sets the limits that are given, and leaves the others.
void set_limits(const TestLimits& given, Tolerance& pixels, RunTolerance& run);

/// One picture that two films, or two files, share.
struct FrameDifference {
    std::string name;
    std::filesystem::path expected, actual;
    PixelDifference pixels;
    Sameness sameness = Sameness::identical;
    int number = 0;  ///< of the picture in its file
};

/// All pictures of two files: one each, or the frames of two animations or films. Throws
/// std::invalid_argument where the two cannot be compared.
std::vector<FrameDifference> compare_pictures(const std::string& name, const std::filesystem::path& expected,
                                              const std::filesystem::path& actual,
                                              const Tolerance& tolerance);

/// The numbers of a frame's difference as a table of the page.
DifferenceTable pixel_table(const PixelDifference& difference, const Tolerance& tolerance);
/// Both pictures and their heat map for the page.
DifferencePage::Pictures page_pictures(const std::string& name, const Image& expected, const Image& actual,
                                       const PixelDifference& difference);
/// expected.png, actual.png, heat.png and flicker.apng, half a second each.
void write_difference_pictures(const std::filesystem::path& folder, const Image& expected,
                               const Image& actual, const PixelDifference& difference);

/// "worst tile 6.3 (limit 3), ..." : what does not hold.
std::string beyond(const PixelDifference& difference, const Tolerance& tolerance);

}  // namespace hibi
