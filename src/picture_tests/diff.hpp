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
    std::filesystem::path expected, actual;     ///< two pictures, folders of pictures, frames.json, or runs
    std::filesystem::path output = "out/diff";  ///< folder of the pictures and the page
    std::optional<std::filesystem::path> junit{};
    bool json = false;  ///< print JSON in place of the verdict
    Tolerance pixels{};
    RunTolerance run{};
};

/// `hibi diff`: compares two pictures, two folders of pictures, two lists of frames or two runs; writes
/// expected.png, actual.png, heat.png, flicker.apng (of the worst frame) and difference.html; prints the
/// verdict. Returns 0 where both are the same, 3 where not. Throws std::invalid_argument naming the file for
/// what cannot be compared.
int diff_command(const DiffOptions& options);

/// Sets the limits that are given, and leaves the others.
void set_limits(const TestLimits& given, Tolerance& pixels, RunTolerance& run);

/// A picture that is to be compared, 8 bits per channel. Throws std::invalid_argument naming the file, what
/// is wrong with it and a way out.
Image picture_to_compare(const std::filesystem::path& file);

/// One frame that two films share.
struct FrameDifference {
    std::string name;
    std::filesystem::path expected, actual;
    PixelDifference pixels;
    Sameness sameness = Sameness::identical;
};

/// Throws std::invalid_argument where the two cannot be compared.
FrameDifference compare_frame(const std::string& name, const std::filesystem::path& expected,
                              const std::filesystem::path& actual, const Tolerance& tolerance);

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
