#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "image/difference.hpp"
#include "picture_tests/compared_files.hpp"
#include "report/difference_page.hpp"

namespace hibi {

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

/// The same for every file, on all cores. Both must have the same names.
std::vector<FrameDifference> compare_files(const NamedFiles& expected, const NamedFiles& actual,
                                           const Tolerance& tolerance);

/// By how much a frame is beyond, or how near it is to, the limits: at most 1 where all hold.
double badness(const FrameDifference& frame, const Tolerance& tolerance);

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
