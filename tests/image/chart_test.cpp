#include "image/chart.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

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
    unsigned random = 1;
    for (int k = 0; k < 5000; ++k) {
        random = random * 1664525u + 1013904223u;
        chart.lines[0].x.push_back(k);
        chart.lines[0].y.push_back(random >> 8);
    }
    EXPECT_LT(chart_svg({chart}, {}).size(), 100'000u) << "of nothing but noise";
    for (int k = 0; k < 5000; ++k) chart.lines[0].y[k] = std::sin(0.002 * k);
    EXPECT_LT(chart_svg({chart}, {}).size(), 25'000u) << "mostly letters";
}

TEST(Chart, SvgIsAsWideOnPaperAndNamesNothingThatAPageCouldHaveTwice) {
    const std::string svg = chart_svg({rising()}, {.width_mm = 85});
    EXPECT_NE(svg.find("width=\"85.00mm\""), std::string::npos);
    EXPECT_NE(svg.find("viewBox=\"0 0 240.94 "), std::string::npos);  // 85 mm in points
    EXPECT_EQ(svg.find(" id="), std::string::npos);
    Chart special = rising();
    special.title = "\"a\" < b & c";
    EXPECT_NE(chart_svg({special}, {}).find("<title>&quot;a&quot; &lt; b &amp; c</title>"),
              std::string::npos);
}

/// How many pixels of lines, numbers and words in one picture are different in the other.
int hidden(const Image& before, const Image& after, const Theme& colours) {
    int count = 0;
    for (int y = 0; y < before.height; ++y)
        for (int x = 0; x < before.width; ++x) {
            const std::uint8_t *b = before.pixel(x, y), *a = after.pixel(x, y);
            if (std::equal(b, b + 3, a)) continue;
            bool empty = true;  // background, or a grid line on it
            for (int c = 0; c < 3; ++c) {
                const auto [low, high] = std::minmax(colours.background[2 - c], colours.grid[2 - c]);
                empty = empty && b[c] >= std::lround(255 * low) - 2 && b[c] <= std::lround(255 * high) + 2;
            }
            count += !empty;
        }
    return count;
}

TEST(Chart, LabelsOfDotsHideNoData) {
    Chart chart{.x = {"Displacement", "m"}, .y = {"Load", "N"}};
    for (int k = 0; k < 4; ++k) {
        ChartLine line{.colour = k};
        for (int i = 0; i <= 200; ++i) {
            line.x.push_back(0.001 * i * (4 + k));
            line.y.push_back((1 + 0.12 * k) * std::sin(0.012 * i) + 0.02 * std::sin(0.6 * i));
        }
        chart.lines.push_back(line);
        chart.marks.push_back({line.x[190], line.y[190], ""});
    }
    Chart labelled = chart;
    for (ChartMark& mark : labelled.marks) mark.label = "Event";
    for (const std::string& name : theme_names())
        for (const double mm : {85.0, 170.0}) {
            const FigureStyle style{.theme = name, .width_mm = mm};
            const Image before = chart_image({chart}, style), after = chart_image({labelled}, style);
            ASSERT_NE(pixel_hash(after), pixel_hash(before));
            EXPECT_EQ(hidden(before, after, theme(name)), 0) << name << mm;
        }
}

TEST(Chart, LinesAreNamedAtTheirEndsWhereTheseAreAtTheRight) {
    Chart chart = rising();
    chart.lines.push_back({.label = "other", .x = {0, 1}, .y = {6e7, 0}, .colour = 1});
    std::vector<ChartPlace> at_ends, in_legend;
    chart_svg({chart}, {.width_mm = 85}, &at_ends);
    chart.lines[1].x[1] = 0.5;
    chart_svg({chart}, {.width_mm = 85}, &in_legend);
    EXPECT_GT(in_legend[0].axes.width, at_ends[0].axes.width + 15);
    EXPECT_GT(in_legend[0].axes.y, at_ends[0].axes.y + 8);
}

TEST(Chart, WordsOfEventsStandAboveTheAxes) {
    Chart chart = rising();
    chart.marks = {{0.90, {}, "First break"}, {0.93, {}, "Separation"}};
    Chart nameless = chart;
    for (ChartMark& mark : nameless.marks) mark.label = "";
    const FigureStyle style{.theme = "print", .width_mm = 85};
    std::vector<ChartPlace> places, without;
    chart_svg({chart}, style, &places);
    chart_svg({nameless}, style, &without);
    EXPECT_GT(places[0].axes.y, without[0].axes.y + 8) << "two rows of words, one more than the title has";
    // Between them and the line of the data only the two lines of the marks are dark.
    const Image image = chart_image({chart}, style);
    const ChartPlace& p = places[0];
    const int y = static_cast<int>(style.points(p.axes.y)) + 6;
    int dark = 0;
    for (int x = static_cast<int>(style.points(p.axes.x)) + 6; x < image.width; ++x)
        dark += image.pixel(x, y)[1] < 150;
    EXPECT_GE(dark, 2);
    EXPECT_LE(dark, 8);
}

TEST(Chart, LinesEndAtARangeThatIsGiven) {
    Chart chart = rising();
    chart.x.range = {0.25, 0.75};
    chart.y.range = {2e7, 4e7};
    const FigureStyle style{.theme = "light", .width_mm = 85};
    std::vector<ChartPlace> places;
    chart_svg({chart}, style, &places);
    const ChartPlace& p = places[0];
    EXPECT_EQ(p.x, (std::array{0.25, 0.75}));
    EXPECT_EQ(p.y, (std::array{2e7, 4e7}));
    const Image image = chart_image({chart}, style);
    const auto inside = [&](double at, double begin, double length) {
        return at > style.points(begin) - 4 && at < style.points(begin + length) + 4;
    };
    int seen = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            if (is(image.pixel(x, y), theme("light").series[0])) {
                ++seen;
                ASSERT_TRUE(inside(x, p.axes.x, p.axes.width) && inside(y, p.axes.y, p.axes.height));
            }
    EXPECT_GT(seen, 500);
}

TEST(Chart, NumbersOfLogarithmicAxesAreRoundOrTheValues) {
    const auto svg_of = [](std::vector<double> x, std::vector<double> y) {
        const Chart chart{.x = {.title = "x", .unit = "m", .logarithmic = true},
                          .y = {.title = "y", .unit = "N", .logarithmic = true},
                          .lines = {{.x = std::move(x), .y = std::move(y)}}};
        return chart_svg({chart}, {.width_mm = 85});
    };
    const auto has = [](const std::string& svg, const std::string& words) {
        return svg.find("aria-label=\"" + words + "\"") != std::string::npos;
    };
    const std::string few = svg_of({0.5, 1, 2}, {3.03e7, 3.53e7, 5.8e7});
    for (const char* words : {"0.5", "2", "30", "40", "50", "y (MN)"}) EXPECT_TRUE(has(few, words)) << words;
    EXPECT_TRUE(has(svg_of({50, 3200}, {1, 2}), "3.2"));  // km
    const std::string many = svg_of({1e-5, 1}, {1e-3, 1e9});
    for (const char* words : {"10⁻⁵", "10⁶", "y (N)"}) EXPECT_TRUE(has(many, words)) << words;
    const std::string some = svg_of({1, 2, 3, 4, 5, 6, 70}, {0.02, 1, 1, 1, 1, 1, 60});
    for (const char* words : {"0.1", "1", "10", "50"}) EXPECT_TRUE(has(some, words)) << words;
}

TEST(Chart, ASinglePointIsSeen) {
    const Chart chart{.x = {"x", ""}, .y = {"y", "N"}, .lines = {{.x = {2}, .y = {3}}}};
    const FigureStyle style{.theme = "light", .width_mm = 85};
    std::vector<ChartPlace> places;
    chart_svg({chart}, style, &places);
    EXPECT_TRUE(near(chart_image({chart}, style), style, places[0].pixel_x(2), places[0].pixel_y(3),
                     theme("light").series[0]));
}

TEST(Chart, AMissingGlyphIsAnError) {
    Chart chart = rising();
    chart.title = "Crack 😀";
    EXPECT_THROW(chart_svg({chart}, {}), std::runtime_error);
    EXPECT_THROW(chart_image({chart}, {}), std::runtime_error);
}

}  // namespace
}  // namespace hibi
