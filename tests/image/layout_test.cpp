#include "image/layout.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace hibi {
namespace {

using Size = std::array<int, 2>;
const std::vector<Size> sizes = {{3840, 2160}, {1920, 1080}, {1440, 1080}, {1280, 720}, {1080, 1080},
                                 {1080, 1920}, {720, 1280},  {640, 640},   {640, 360},  {480, 270},
                                 {320, 320},   {320, 180},   {180, 320},   {160, 90},   {64, 64},
                                 {16, 16},     {2000, 100},  {100, 2000}};

std::vector<PixelRect> places(const Layout& l) {
    std::vector<PixelRect> shown;
    for (const PixelRect& r : {l.title, l.plot, l.footer, l.readout, l.colour_bar, l.legend, l.curve})
        if (r.width > 0 && r.height > 0) shown.push_back(r);
    return shown;
}

bool overlap(const PixelRect& a, const PixelRect& b) {
    constexpr double rounding = 1e-9;
    return a.x + a.width > b.x + rounding && b.x + b.width > a.x + rounding &&
           a.y + a.height > b.y + rounding && b.y + b.height > a.y + rounding;
}

TEST(Layout, NothingOverlapsAndNothingIsCutAtAnySize) {
    for (const Size& size : sizes)
        for (int mask = 0; mask < 512; ++mask) {
            const auto bit = [&](int k) { return (mask >> k & 1) == 1; };
            const Layout l = lay_out(size[0], size[1],
                                     {.title = bit(0),
                                      .subtitle = bit(1),
                                      .time = bit(2),
                                      .load = bit(3),
                                      .counts = bit(4),
                                      .colour_bar = bit(5),
                                      .legend = bit(6),
                                      .curve = bit(7),
                                      .scale_bar = bit(8)});
            const std::vector<PixelRect> shown = places(l);
            for (std::size_t i = 0; i < shown.size(); ++i) {
                EXPECT_GE(shown[i].x, 0);
                EXPECT_GE(shown[i].y, 0);
                EXPECT_LE(shown[i].x + shown[i].width, size[0] + 1e-9)
                    << size[0] << "x" << size[1] << " " << mask;
                EXPECT_LE(shown[i].y + shown[i].height, size[1] + 1e-9)
                    << size[0] << "x" << size[1] << " " << mask;
                for (std::size_t j = 0; j < i; ++j)
                    ASSERT_FALSE(overlap(shown[i], shown[j])) << size[0] << "x" << size[1] << " " << mask;
            }
        }
}

TEST(Layout, UsualSizesShowEverything) {
    for (const Size& size :
         {Size{1920, 1080}, Size{1280, 720}, Size{1080, 1080}, Size{1080, 1920}, Size{640, 360}}) {
        const Parts p = lay_out(size[0], size[1], {}).parts;
        EXPECT_TRUE(p.title && p.subtitle && p.time && p.load && p.counts && p.colour_bar && p.legend &&
                    p.curve && p.scale_bar)
            << size[0] << "x" << size[1];
    }
}

TEST(Layout, SmallPicturesKeepLegibleTextAndDropPartsInOrder) {
    int dropped_before = 0;
    for (int height = 720; height >= 40; height -= 4) {
        const Layout l = lay_out(height * 16 / 9, height, {});
        EXPECT_GE(l.text, 9);
        const Parts& p = l.parts;
        const bool column[] = {p.curve, p.legend, p.counts, p.load, p.colour_bar, p.time};
        int dropped = 0;
        for (const bool part : column) dropped += !part;
        for (int k = 0; k < dropped; ++k) EXPECT_FALSE(column[k]) << height;
        EXPECT_GE(dropped, dropped_before) << height;
        dropped_before = dropped;
    }
    EXPECT_EQ(dropped_before, 6);  // a thumbnail is the body alone
    EXPECT_FALSE(lay_out(320, 180, {}).parts.curve);
    EXPECT_TRUE(lay_out(320, 180, {}).parts.colour_bar);
}

TEST(Layout, TheBodyGetsTheLargestPart) {
    for (const Size& size :
         {Size{1920, 1080}, Size{1080, 1080}, Size{1080, 1920}, Size{640, 360}, Size{320, 180}}) {
        const PixelRect plot = lay_out(size[0], size[1], {}).plot;
        EXPECT_GT(plot.width * plot.height, 0.4 * size[0] * size[1]) << size[0] << "x" << size[1];
    }
    EXPECT_GT(lay_out(1920, 1080,
                      {.time = false,
                       .load = false,
                       .counts = false,
                       .colour_bar = false,
                       .legend = false,
                       .curve = false})
                  .plot.width,
              1700);
}

}  // namespace
}  // namespace hibi
