#include "image/sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "image/theme.hpp"

namespace hibi {
namespace {

TEST(Sheet, PanelsStandInRowsAtTheirWidth) {
    const FigureStyle style{.theme = "light", .width_mm = 170};
    const int width = panel_width(3, style);
    std::vector<Panel> panels;
    for (int k = 0; k < 5; ++k) {
        Image image(width, 100);
        for (int i = 0; i < width * 100; ++i) image.bgra[4 * i + 2] = static_cast<std::uint8_t>(50 * k);
        panels.push_back(
            {image, "Panel", "a detail that is much longer than the panel is wide, so that it is broken"});
    }
    const Image sheet = make_sheet(panels, "Title", 3, style);
    EXPECT_EQ(sheet.width, style.width());
    // Every panel once, in order: the red of its own, somewhere, the second row below the first.
    std::vector<std::array<int, 2>> found(5, {-1, -1});
    for (int y = 0; y < sheet.height; ++y)
        for (int x = 0; x < sheet.width; ++x) {
            const std::uint8_t* p = sheet.pixel(x, y);
            for (int k = 0; k < 5; ++k)
                if (found[k][0] < 0 && p[0] == 0 && p[1] == 0 && p[2] == 50 * k) found[k] = {x, y};
        }
    for (int k = 0; k < 5; ++k) ASSERT_GE(found[k][0], 0) << k;
    EXPECT_EQ(found[1][1], found[2][1]);
    EXPECT_GT(found[2][0], found[1][0] + width - 1);
    EXPECT_GT(found[3][1], found[1][1] + 100);
    EXPECT_EQ(found[4][0], found[1][0]);
}

/// Pixels outside the panels' pictures that are not background.
int written(const Image& sheet, const Rgb& background, int x0, int y0, int x1, int y1) {
    int count = 0;
    for (int y = std::max(0, y0); y < std::min(sheet.height, y1); ++y)
        for (int x = std::max(0, x0); x < std::min(sheet.width, x1); ++x)
            for (int c = 0; c < 3; ++c)
                if (std::abs(sheet.pixel(x, y)[c] - std::lround(255 * background[2 - c])) > 3) {
                    ++count;
                    break;
                }
    return count;
}

TEST(Sheet, LongWordsStayBelowTheirPanelAndInsideThePicture) {
    const std::string words =
        "片持ち平板の曲げ破壊 with spacing = 0.125 m and a label that never ends, ever and ever";
    for (const std::string& name : theme_names())
        for (const double mm : {85.0, 170.0}) {
            const FigureStyle style{.theme = name, .width_mm = mm};
            const Rgb& background = theme(name).background;
            const int width = panel_width(2, style);
            Image empty(width, 60);
            for (int i = 0; i < width * 60; ++i)
                for (int c = 0; c < 3; ++c)
                    empty.bgra[4 * i + c] = static_cast<std::uint8_t>(std::lround(255 * background[2 - c]));
            const Image sheet = make_sheet({{empty, words, words}, {empty, words, words}}, words, 2, style);
            const int w = sheet.width, h = sheet.height,
                      gap = w / 2 - static_cast<int>(style.margin()) - width;
            ASSERT_GT(written(sheet, background, 0, 0, w, h), 2000);
            EXPECT_EQ(written(sheet, background, 0, 0, w, 3), 0);
            EXPECT_EQ(written(sheet, background, 0, h - 3, w, h), 0);
            EXPECT_EQ(written(sheet, background, 0, 0, 3, h), 0);
            EXPECT_EQ(written(sheet, background, w - 3, 0, w, h), 0);
            ASSERT_GT(gap, 5);
            EXPECT_EQ(written(sheet, background, w / 2 - gap + 3, h / 2, w / 2 + gap - 3, h), 0)
                << name << mm;
        }
}

TEST(Sheet, ATitleNeedsRoomAndNoTitleNone) {
    const FigureStyle style{.theme = "light", .width_mm = 85};
    const std::vector<Panel> panels{{Image(panel_width(1, style), 50), "a", ""}};
    EXPECT_GT(make_sheet(panels, "Title", 1, style).height,
              make_sheet(panels, "", 1, style).height + static_cast<int>(style.text()));
}

TEST(Sheet, AMissingGlyphIsAnError) {
    const FigureStyle style{.theme = "light", .width_mm = 85};
    EXPECT_THROW(make_sheet({{Image(10, 10), "😀", ""}}, "", 1, style), std::runtime_error);
}

}  // namespace
}  // namespace hibi
