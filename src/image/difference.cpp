#include "image/difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "image/theme.hpp"

namespace hibi {

namespace {

/// 256 times the luma of BT.709, so that whole numbers do.
int luma(const std::uint8_t* bgra) { return 19 * bgra[0] + 183 * bgra[1] + 54 * bgra[2]; }
constexpr double luma_unit = 256;

int channel_difference(const std::uint8_t* a, const std::uint8_t* b) {
    return std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

/// Left or upper edges of tiles along one side: every tile_stride, and one that ends with the picture.
std::vector<int> tile_edges(int length) {
    const int last = std::max(0, length - PixelDifference::tile_size);
    std::vector<int> edges;
    for (int at = 0; at < last; at += PixelDifference::tile_stride) edges.push_back(at);
    edges.push_back(last);
    return edges;
}

/// The worst tile, from a table of sums over everything left of and above a pixel.
void find_worst_tile(const Image& a, const Image& b, PixelDifference& d) {
    const int width = a.width, height = a.height, row = width + 1;
    std::vector<std::uint64_t> sums(static_cast<std::size_t>(row) * (height + 1));
    for (int y = 0; y < height; ++y) {
        const std::uint8_t *pa = a.pixel(0, y), *pb = b.pixel(0, y);
        const std::uint64_t* above = sums.data() + static_cast<std::size_t>(row) * y;
        std::uint64_t *here = sums.data() + static_cast<std::size_t>(row) * (y + 1), line = 0;
        for (int x = 0; x < width; ++x) {
            const std::int64_t off = luma(pa + 4 * x) - luma(pb + 4 * x);
            line += static_cast<std::uint64_t>(off * off);
            here[x + 1] = above[x + 1] + line;
        }
    }
    const int w = std::min(width, PixelDifference::tile_size),
              h = std::min(height, PixelDifference::tile_size);
    std::uint64_t worst = 0;
    const auto at = [&](int x, int y) { return sums[static_cast<std::size_t>(row) * y + x]; };
    for (const int y : tile_edges(height))
        for (const int x : tile_edges(width)) {
            const std::uint64_t sum = at(x + w, y + h) + at(x, y) - at(x + w, y) - at(x, y + h);
            if (sum > worst) worst = sum, d.tile_at = {x, y};
        }
    d.tile = std::sqrt(static_cast<double>(worst) / (w * h)) / luma_unit;
}

/// Wang, Bovik, Sheikh & Simoncelli 2004, IEEE Transactions on Image Processing 13, with blocks side by side
/// in place of a sliding window; what is left at the edges does not count.
double similarity(const Image& a, const Image& b) {
    constexpr int block = 8, n = block * block;
    constexpr double c1 = 0.01 * 255 * 0.01 * 255, c2 = 0.03 * 255 * 0.03 * 255;
    double total = 0;
    int blocks = 0;
    for (int y = 0; y + block <= a.height; y += block)
        for (int x = 0; x + block <= a.width; x += block, ++blocks) {
            std::int64_t sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
            for (int j = 0; j < block; ++j) {
                const std::uint8_t *pa = a.pixel(x, y + j), *pb = b.pixel(x, y + j);
                for (int i = 0; i < 4 * block; i += 4) {
                    const std::int64_t va = luma(pa + i), vb = luma(pb + i);
                    sa += va, sb += vb, saa += va * va, sbb += vb * vb, sab += va * vb;
                }
            }
            const auto mean = [](std::int64_t sum, double unit) {
                return static_cast<double>(sum) / (n * unit);
            };
            const double ma = mean(sa, luma_unit), mb = mean(sb, luma_unit);
            const double square = luma_unit * luma_unit;
            const double va = mean(saa, square) - ma * ma, vb = mean(sbb, square) - mb * mb,
                         cov = mean(sab, square) - ma * mb;
            total += (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
        }
    return blocks > 0 ? total / blocks : 1;
}

PixelDifference opaque_difference(const Image& a, const Image& b) {
    PixelDifference d;
    const std::size_t pixels = static_cast<std::size_t>(a.width) * a.height;
    std::array<std::int64_t, 3> sum{}, squares{};
    for (std::size_t p = 0; p < pixels; ++p) {
        const std::uint8_t *pa = a.bgra.data() + 4 * p, *pb = b.bgra.data() + 4 * p;
        int largest = 0;
        for (int c = 0; c < 3; ++c) {
            const int off = pb[c] - pa[c];
            sum[c] += off;
            squares[c] += off * off;
            largest = std::max(largest, std::abs(off));
        }
        d.largest = std::max(d.largest, largest);
        d.far_pixels += largest > Tolerance::far;
    }
    d.identical = d.largest == 0;
    if (d.identical) return d;
    const double count = static_cast<double>(pixels);
    d.pixels = 1e6 * d.far_pixels / count;
    for (int c = 0; c < 3; ++c) {
        d.mean[c] = static_cast<double>(sum[2 - c]) / count;
        d.rmse[c] = std::sqrt(static_cast<double>(squares[2 - c]) / count);
    }
    find_worst_tile(a, b, d);
    d.ssim = similarity(a, b);
    return d;
}

PixelDifference worse_of(PixelDifference a, const PixelDifference& b) {
    a.identical = a.identical && b.identical;
    if (b.tile > a.tile) a.tile = b.tile, a.tile_at = b.tile_at;
    a.far_pixels = std::max(a.far_pixels, b.far_pixels);
    a.pixels = std::max(a.pixels, b.pixels);
    for (int c = 0; c < 3; ++c) {
        if (std::abs(b.mean[c]) > std::abs(a.mean[c])) a.mean[c] = b.mean[c];
        a.rmse[c] = std::max(a.rmse[c], b.rmse[c]);
    }
    a.largest = std::max(a.largest, b.largest);
    a.ssim = std::min(a.ssim, b.ssim);
    return a;
}

constexpr Rgb black{0, 0, 0}, white{1, 1, 1};

double largest_of(const std::array<double, 3>& channels) {
    return std::max({std::abs(channels[0]), std::abs(channels[1]), std::abs(channels[2])});
}

bool far_pixels_hold(const PixelDifference& d, const Tolerance& tolerance) {
    return d.pixels <= tolerance.pixels || (tolerance.pixels > 0 && d.far_pixels <= 1);
}

}  // namespace

PixelDifference difference(const Image& expected, const Image& actual) {
    if (expected.width != actual.width || expected.height != actual.height)
        throw std::invalid_argument(fmt::format("one picture has {} x {} pixels, the other {} x {}",
                                                expected.width, expected.height, actual.width,
                                                actual.height));
    if (is_opaque(expected) && is_opaque(actual)) return opaque_difference(expected, actual);
    return worse_of(opaque_difference(laid_on(expected, black), laid_on(actual, black)),
                    opaque_difference(laid_on(expected, white), laid_on(actual, white)));
}

const char* to_string(Sameness sameness) {
    return sameness == Sameness::identical   ? "identical"
           : sameness == Sameness::tolerated ? "within tolerance"
                                             : "different";
}

std::vector<Measure> measures(const PixelDifference& d, const Tolerance& tolerance) {
    const double mean = largest_of(d.mean), rmse = largest_of(d.rmse);
    return {{"worst tile", d.tile, tolerance.tile, d.tile <= tolerance.tile},
            {"pixels far off per megapixel", d.pixels, tolerance.pixels, far_pixels_hold(d, tolerance)},
            {"mean difference", mean, tolerance.mean, mean <= tolerance.mean},
            {"RMS difference", rmse, tolerance.rmse, rmse <= tolerance.rmse}};
}

Sameness judge(const PixelDifference& d, const Tolerance& tolerance) {
    if (d.identical) return Sameness::identical;
    return std::ranges::all_of(measures(d, tolerance), &Measure::holds) ? Sameness::tolerated
                                                                        : Sameness::different;
}

Image heat_map(const Image& expected, const Image& actual, const PixelDifference& d) {
    constexpr double full = 64;
    const ColourMap& map = colour_map("inferno");
    Image heat(expected.width, expected.height);
    for (std::size_t p = 0; p < heat.bgra.size(); p += 4) {
        const std::uint8_t *a = expected.bgra.data() + p, *b = actual.bgra.data() + p;
        const int alpha = (expected.transparent ? a[3] : 255) - (actual.transparent ? b[3] : 255);
        const int off = std::max(channel_difference(a, b), std::abs(alpha));
        std::uint8_t* pixel = heat.bgra.data() + p;
        if (off == 0) {
            pixel[0] = pixel[1] = pixel[2] = static_cast<std::uint8_t>(luma(a) / (5 * 256));
            continue;
        }
        // By the root, or what rounding does could not be seen.
        const auto& colour = map[static_cast<std::size_t>(255 * std::min(1.0, std::sqrt(off / full)))];
        for (int c = 0; c < 3; ++c) pixel[c] = colour[2 - c];
    }
    if (d.identical) return heat;
    // Just outside of the tile, so that nothing of it is hidden.
    const int x0 = d.tile_at[0] - 1, y0 = d.tile_at[1] - 1;
    const int x1 = x0 + 1 + std::min(heat.width, PixelDifference::tile_size),
              y1 = y0 + 1 + std::min(heat.height, PixelDifference::tile_size);
    const auto frame = [&](int x, int y) {
        if (x >= 0 && y >= 0 && x < heat.width && y < heat.height) std::memset(heat.pixel(x, y), 255, 3);
    };
    for (int x = x0; x <= x1; ++x) frame(x, y0), frame(x, y1);
    for (int y = y0; y <= y1; ++y) frame(x0, y), frame(x1, y);
    return heat;
}

}  // namespace hibi
