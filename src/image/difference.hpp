#pragma once
#include <array>
#include <string>
#include <vector>

#include "image/image.hpp"

namespace hibi {

/// How much two pictures may differ and still count as the same: all four hold. The defaults stand between
/// what rounding does (other vector widths, other processors) and what a missing bond does; scenes/TESTING.md
/// has the measurements.
struct Tolerance {
    /// Of the worst tile: root of its mean squared luma difference. Rounding reaches 0.4 in the project's own
    /// scenes, a region moved by one pixel 4.8 or more.
    double tile = 3.0;
    /// Pixels with a channel off by more than Tolerance::far, in a megapixel; in a small picture one such
    /// pixel is allowed.
    double pixels = 8;
    /// Largest of the channels' mean signed differences: the only one that sees all colours shift a little,
    /// such as 3 % less saturation.
    double mean = 0.6;
    /// Largest of the channels' root mean squared differences.
    double rmse = 1.5;

    static constexpr int far = 16;
};

/// What tells two pictures of one size apart. Channels in steps of 1/255, in the order R, G, B; luma as in
/// BT.709. Where one of the pictures is not opaque, the worse of both values, over black and over white: an
/// alpha that hides nothing changes nothing.
struct PixelDifference {
    static constexpr int tile_size = 32, tile_stride = 16;

    bool identical = true;             ///< equal pixel_hash
    double tile = 0;                   ///< RMSE of luma in the worst tile
    std::array<int, 2> tile_at{0, 0};  ///< its left upper pixel
    int far_pixels = 0;                ///< with a channel off by more than Tolerance::far
    double pixels = 0;                 ///< the same per megapixel
    std::array<double, 3> mean{}, rmse{};
    int largest = 0;  ///< difference of any channel
    double ssim = 1;  ///< structural similarity of luma, mean over 8 x 8 blocks; reported, decides nothing
};

/// Throws std::invalid_argument where the sizes are not the same.
PixelDifference difference(const Image& expected, const Image& actual);

enum class Sameness { identical, tolerated, different };
const char* to_string(Sameness sameness);  ///< "identical", "within tolerance", "different"
Sameness judge(const PixelDifference& difference, const Tolerance& tolerance);

/// One measured value beside its limit.
struct Measure {
    std::string name;
    double value = 0, limit = 0;
    bool holds = true;
};
/// The four that decide, in the order of Tolerance.
std::vector<Measure> measures(const PixelDifference& difference, const Tolerance& tolerance);

/// Where the pictures differ: the expected one, faint and grey, and over it each pixel that is off, the
/// brighter the more (full at 64). The worst tile is framed.
Image heat_map(const Image& expected, const Image& actual, const PixelDifference& difference);

}  // namespace hibi
