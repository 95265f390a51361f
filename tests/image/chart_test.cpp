#include "image/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "image/sheet.hpp"
#include "image/theme.hpp"

namespace hibi {
namespace {

Chart rising() {
    Chart chart{
        .title = "A title", .x = {"Displacement", "m"}, .y = {"Load", "N"}, .lines = {{.label = "load"}}};
    for (int k = 0; k <= 20; ++k) {
        chart.lines[0].x.push_back(0.05 * k);
        chart.lines[0].y.push_back(3e6 * k);
    }
    return chart;
}

bool is(const std::uint8_t* pixel, const Rgb& colour, int within = 3) {
    for (int c = 0; c < 3; ++c)
        if (std::abs(pixel[2 - c] - std::lround(255 * colour[c])) > within) return false;
    return true;
}

/// Whether a colour occurs within a few pixels of a place given in points.
bool near(const Image& image, const FigureStyle& style, double x, double y, const Rgb& colour) {
    const int px = static_cast<int>(style.points(x)), py = static_cast<int>(style.points(y));
    for (int dy = -3; dy <= 3; ++dy)
        for (int dx = -3; dx <= 3; ++dx)
            if (px + dx >= 0 && py + dy >= 0 && px + dx < image.width && py + dy < image.height &&
                is(image.pixel(px + dx, py + dy), colour))
                return true;
    return false;
}

TEST(Chart, PlacesSayWhereTheDataAre) {
    const FigureStyle style{.theme = "light", .width_mm = 85};
    std::vector<ChartPlace> places;
    chart_svg({rising()}, style, &places);
    ASSERT_EQ(places.size(), 1u);
    const Image image = chart_image({rising()}, style);
    const ChartPlace& p = places[0];
    for (const double share : {0.2, 0.5, 0.9}) {
        EXPECT_TRUE(near(image, style, p.pixel_x(share), p.pixel_y(6e7 * share), theme("light").series[0]))
            << share;
        EXPECT_FALSE(
            near(image, style, p.pixel_x(share), p.pixel_y(6e7 * share) - 20, theme("light").series[0]));
    }
}

TEST(Chart, ALogarithmicPlaceTakesEqualStepsForEqualFactors) {
    Chart chart = rising();
    chart.x.logarithmic = chart.y.logarithmic = true;
    chart.lines[0] = {.x = {0.5, 1, 2, 4, 0, -1}, .y = {1, 10, 100, 1000, 5, 5}};
    std::vector<ChartPlace> places;
    chart_svg({chart}, {}, &places);
    const ChartPlace& p = places[0];
    EXPECT_NEAR(p.pixel_x(2) - p.pixel_x(1), p.pixel_x(4) - p.pixel_x(2), 1e-9);
    EXPECT_NEAR(p.pixel_y(100) - p.pixel_y(10), p.pixel_y(1000) - p.pixel_y(100), 1e-9);
    EXPECT_GT(p.x[0], 0);
    EXPECT_LT(p.x[0], 0.5) << "what is not above zero does not stretch the axis";
}

TEST(Chart, StandSideBySideWhereThereIsRoomForThem) {
    std::vector<ChartPlace> wide, narrow;
    chart_svg({rising(), rising()}, {.width_mm = 170}, &wide);
    chart_svg({rising(), rising()}, {.width_mm = 85}, &narrow);
    EXPECT_EQ(wide[0].axes.y, wide[1].axes.y);
    EXPECT_GT(wide[1].axes.x, wide[0].axes.x + wide[0].axes.width);
    EXPECT_EQ(narrow[0].axes.x, narrow[1].axes.x);
    EXPECT_GT(narrow[1].axes.y, narrow[0].axes.y + narrow[0].axes.height);
}

TEST(Chart, ImagesHaveTheWidthOnPaper) {
    for (const double mm : {85.0, 170.0})
        EXPECT_EQ(chart_image({rising()}, {.width_mm = mm}).width, std::lround(mm / 25.4 * 300));
}

TEST(Chart, NothingTouchesTheEdgeInAnyThemeAndWidth) {
    Chart chart = rising();
    chart.lines.push_back(
        {.label = "a second line with a long name", .x = {0, 1}, .y = {0, 7e7}, .colour = 1});
    chart.lines.push_back({.label = "a third one", .x = {0, 1}, .y = {6e7, 0}, .colour = 2, .dashed = true});
    chart.marks = {{0.99, 5.9e7, "Peak load, separation"}, {1.0, {}, "A line at the very end"}};
    chart.note =
        "A note that is far too long for one line of the figure and has to be broken into several of them.";
    for (const std::string& name : theme_names())
        for (const double mm : {85.0, 170.0}) {
            const Image image = chart_image({chart}, {.theme = name, .width_mm = mm});
            const Rgb& background = theme(name).background;
            for (int y = 0; y < image.height; ++y)
                ASSERT_TRUE(is(image.pixel(0, y), background) &&
                            is(image.pixel(image.width - 1, y), background))
                    << name << " " << mm << " row " << y;
            for (int x = 0; x < image.width; ++x)
                ASSERT_TRUE(is(image.pixel(x, 0), background) &&
                            is(image.pixel(x, image.height - 1), background))
                    << name << " " << mm << " column " << x;
        }
}

TEST(Chart, ValuesThatAreNotFiniteLeaveAGap) {
    const FigureStyle style{.theme = "light", .width_mm = 85};
    Chart chart = rising();
    for (int k = 8; k <= 12; ++k) chart.lines[0].y[k] = std::numeric_limits<double>::quiet_NaN();
    std::vector<ChartPlace> places;
    chart_svg({chart}, style, &places);
    const Image image = chart_image({chart}, style);
    const auto shown = [&](double x) {
        return near(image, style, places[0].pixel_x(x), places[0].pixel_y(6e7 * x), theme("light").series[0]);
    };
    EXPECT_TRUE(shown(0.3));
    EXPECT_FALSE(shown(0.5));
    EXPECT_TRUE(shown(0.7));
}

TEST(Chart, EmptyAndSingleDataAreDrawnAndSvgIsTheSameTwice) {
    for (const std::vector<double>& x : {std::vector<double>{}, {2.0}}) {
        const Chart chart{.x = {"x", ""}, .y = {"y", "N"}, .lines = {{.x = x, .y = x, .points = true}}};
        EXPECT_GT(chart_image({chart}, {}).height, 100);
        const std::string svg = chart_svg({chart}, {});
        EXPECT_TRUE(svg == chart_svg({chart}, {}));
        EXPECT_EQ(svg.find("nan"), std::string::npos);
        EXPECT_EQ(svg.find("inf"), std::string::npos);
    }
    EXPECT_NE(chart_svg({rising()}, {}).find("<title>A title</title>"), std::string::npos);
    EXPECT_EQ(chart_svg({rising()}, {}).find("<text"), std::string::npos) << "needs no font";
}

TEST(Chart, ALongHistoryStaysASmallFile) {
    Chart chart = rising();
    chart.lines[0] = {.label = "long"};
    for (int k = 0; k < 20000; ++k) {
        chart.lines[0].x.push_back(k);
        chart.lines[0].y.push_back(std::sin(0.001 * k) + 0.01 * std::sin(7.0 * k));
    }
    EXPECT_LT(chart_svg({chart}, {}).size(), 450'000u) << "of 20 000 trembling points";
}

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

}  // namespace
}  // namespace hibi
