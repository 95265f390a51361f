#include "image/polyline.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hibi {
namespace {

constexpr PixelRect box{0, 0, 10, 10};

TEST(Cut, KeepsWhatIsInside) {
    EXPECT_EQ(cut({-5, 5}, {15, 5}, box), (std::array<Point, 2>{Point{0, 5}, Point{10, 5}}));
    EXPECT_EQ(cut({2, 3}, {4, 5}, box), (std::array<Point, 2>{Point{2, 3}, Point{4, 5}}));
    EXPECT_FALSE(cut({-5, 8}, {5, 18}, box));  // passes the corner outside
    EXPECT_FALSE(cut({11, 1}, {11, 9}, box));
}

TEST(Cut, ALineThatLeavesAndComesBackHasTwoParts) {
    const std::vector<Polyline> parts = cut({{1, 1}, {5, 1}, {5, -5}, {8, -5}, {8, 5}}, box);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0], (Polyline{{1, 1}, {5, 1}, {5, 0}}));
    EXPECT_EQ(parts[1], (Polyline{{8, 0}, {8, 5}}));
    EXPECT_EQ(cut({{3, 3}}, box).size(), 1u);
    EXPECT_TRUE(cut({{30, 3}}, box).empty());
}

double distance(const Point& p, const Point& a, const Point& b) {
    const double dx = b[0] - a[0], dy = b[1] - a[1], length = std::hypot(dx, dy);
    const double share =
        length > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length / length, 0.0, 1.0) : 0;
    return std::hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy);
}

TEST(Simplified, SmoothLinesLoseMostPointsAndStayWhereTheyAre) {
    Polyline line;
    for (int k = 0; k <= 5000; ++k) line.push_back({0.04 * k, 50 * std::sin(0.002 * k)});
    const Polyline simple = simplified(line, 0.05);
    EXPECT_LT(simple.size(), 150u);
    EXPECT_EQ(simple.front(), line.front());
    EXPECT_EQ(simple.back(), line.back());
    for (const Point& p : line) {
        double least = 1e9;
        for (std::size_t k = 1; k < simple.size(); ++k)
            least = std::min(least, distance(p, simple[k - 1], simple[k]));
        ASSERT_LT(least, 0.15);
    }
}

TEST(Simplified, AJumpInOneColumnKeepsItsEnds) {
    Polyline line{{0, 0}};
    for (int k = 0; k < 1000; ++k) line.push_back({1, k == 500 ? 9.0 : k == 700 ? -9.0 : 0.001 * k});
    line.push_back({2, 0});
    const Polyline simple = simplified(line, 0.1);
    EXPECT_LE(simple.size(), 6u);
    EXPECT_NE(std::ranges::find(simple, Point{1, 9}), simple.end());
    EXPECT_NE(std::ranges::find(simple, Point{1, -9}), simple.end());
}

TEST(Simplified, ALineThatTurnsBackIsNotCutShort) {
    const Polyline line{{0, 0}, {10, 0}, {4, 0}};
    EXPECT_EQ(simplified(line, 0.1), line);
}

}  // namespace
}  // namespace hibi
