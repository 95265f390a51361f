#include "pictures/symbol_anchors.hpp"

#include <gtest/gtest.h>

#include "support/recorded_cantilever.hpp"

namespace hibi {
namespace {

using Pair = std::array<double, 2>;

/// 10 x 5 particles; particle (i, j) has the number 10 j + i.
Topology plate() { return RecordedCantilever{}.topology(); }

std::vector<int> column(int i) { return {i, 10 + i, 20 + i, 30 + i, 40 + i}; }

TEST(Marks, AClampLiesOnTheOuterSideOfTheHeldParticles) {
    Topology t = plate();
    t.loads.clear();
    t.supports[0].particles = column(0);  // and a second column, which must not show
    for (const int i : column(1)) t.supports[0].particles.push_back(i);
    const std::vector<SymbolAnchor> anchors = find_symbol_anchors(t, true, true);
    ASSERT_EQ(anchors.size(), 1u);
    EXPECT_EQ(anchors[0].kind, Symbol::Kind::clamp);
    EXPECT_EQ(anchors[0].towards, (Pair{-1, 0}));
    std::vector<int> line = anchors[0].particles;
    std::ranges::sort(line);
    EXPECT_EQ(line, column(0));
}

TEST(Marks, RoundingOfTheCentresLosesNoParticle) {
    Topology t = plate();
    t.loads.clear();
    for (Vec3& X : t.reference_position)
        X *= 0.1;  // centres at odd multiples of half a spacing, but for rounding
    for (double& l0 : t.spacing) l0 = 0.1;
    t.supports[0].particles = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9};
    const std::vector<SymbolAnchor> anchors = find_symbol_anchors(t, true, false);
    ASSERT_EQ(anchors.size(), 1u);
    EXPECT_EQ(anchors[0].particles.size(), 10u);
}

TEST(Marks, SupportsFarApartAreDrawnApart) {
    Topology t = plate();
    t.supports = {{"feet", {0, 1, 8, 9}, {false, true, false}}};
    const std::vector<SymbolAnchor> anchors = find_symbol_anchors(t, true, false);
    ASSERT_EQ(anchors.size(), 2u);
    for (const SymbolAnchor& anchor : anchors) {
        EXPECT_EQ(anchor.kind, Symbol::Kind::roller);
        EXPECT_EQ(anchor.towards, (Pair{0, -1}));
        EXPECT_EQ(anchor.particles.size(), 2u);
    }
}

TEST(Marks, ARollerStandsSquareToTheWayItHolds) {
    Topology t = plate();
    t.supports = {{"wall", column(9), {true, false, false}}, {"ceiling", {42, 43, 44}, {false, true, false}}};
    const std::vector<SymbolAnchor> anchors = find_symbol_anchors(t, true, false);
    ASSERT_EQ(anchors.size(), 2u);
    EXPECT_EQ(anchors[0].towards, (Pair{1, 0}));
    EXPECT_EQ(anchors[1].towards, (Pair{0, 1}));
}

TEST(Marks, AForceAlongAFacePushesOntoItsEnd) {
    const std::vector<SymbolAnchor> anchors =
        find_symbol_anchors(plate(), false, true);  // the tip's column, pushed down
    ASSERT_EQ(anchors.size(), 1u);
    EXPECT_EQ(anchors[0].particles, (std::vector<int>{49}));  // the uppermost
    EXPECT_FALSE(anchors[0].pulls);
    EXPECT_EQ(anchors[0].towards, (Pair{0, -1}));
}

TEST(Marks, APullBeginsAtTheFaceAndAPushEndsThere) {
    Topology t = plate();
    t.loads[0].direction = Vec3::UnitX();
    for (const int i : column(8)) t.loads[0].particles.push_back(i);  // behind the face: must not show
    EXPECT_TRUE(find_symbol_anchors(t, false, true).at(0).pulls);
    std::vector<int> line = find_symbol_anchors(t, false, true).at(0).particles;
    std::ranges::sort(line);
    EXPECT_EQ(line, column(9));
    t.loads[0].direction = -Vec3::UnitX();
    EXPECT_FALSE(find_symbol_anchors(t, false, true).at(0).pulls);
}

TEST(Marks, AbsentOnesAreNotDrawn) {
    Topology t = plate();
    EXPECT_TRUE(find_symbol_anchors(t, false, false).empty());
    t.supports[0].particles.clear();
    t.loads[0].particles.clear();
    EXPECT_TRUE(find_symbol_anchors(t, true, true).empty());
}

TEST(Marks, SymbolsFollowTheirParticlesAndTurnWithTheLoad) {
    const SymbolAnchor anchor = find_symbol_anchors(plate(), false, true).at(0);
    const Camera2 camera = Camera2::fit(0, 0, 10, 5, {0, 0, 1000, 500});  // 100 pixels per metre
    std::vector<double> x(50, 0), y(50, 0);
    x[49] = 9;
    y[49] = 3;
    const Symbol down = place_symbol(anchor, x, y, camera, 0.5, 1);
    EXPECT_EQ(down.points, (std::vector<Pair>{{900, 200}}));
    EXPECT_EQ(down.radius, 50);
    EXPECT_EQ(down.direction, (Pair{0, 1}));  // pixels count downward
    EXPECT_EQ(down.size, 0.5);
    const Symbol up = place_symbol(anchor, x, y, camera, -0.5, 1);
    EXPECT_EQ(up.direction, (Pair{0, -1}));
    EXPECT_TRUE(up.pulls);
    EXPECT_EQ(up.size, 0.5);
}

TEST(Marks, ArrowsOfALineAreEvenlySpreadAndFarEnoughApart) {
    Topology t = plate();
    t.loads[0].particles = {40, 41, 42, 43, 44, 45, 46, 47, 48, 49};  // the top row, pushed down
    const SymbolAnchor anchor = find_symbol_anchors(t, false, true).at(0);
    std::vector<double> x, y;
    for (const Vec3& X : t.reference_position) x.push_back(X.x()), y.push_back(X.y());
    const Camera2 camera =
        Camera2::fit(0, 0, 10, 5, {0, 0, 150, 75});  // 15 pixels per metre: too close for one each
    const auto points = place_symbol(anchor, x, y, camera, 1, 1).points;
    ASSERT_EQ(points.size(), 4u);  // 135 pixels hold three distances of at least 34
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(std::abs(points[k][0] - points[0][0]), 45 * k, 1e-9);
}

/// Positions of the unloaded plate, 10 m x 5 m.
struct Positions {
    std::vector<double> x, y;
    explicit Positions(const Topology& t) {
        for (const Vec3& X : t.reference_position) x.push_back(X.x()), y.push_back(X.y());
    }
};

TEST(Camera, ShowsWindowAndSymbolsInsideThePlotAsLargeAsPossible) {
    const View view;
    const Positions at(plate());
    const PixelRect plot{60, 150, 1400, 800};
    const double clamp = symbol_reach(Symbol::Kind::clamp, view),
                 arrow = symbol_reach(Symbol::Kind::arrow, view);
    std::vector<Reserved> reserved;
    for (const SymbolAnchor& anchor : find_symbol_anchors(plate(), true, true))
        for (const Reserved& r : reserve(anchor, at.x, at.y, 1, view)) reserved.push_back(r);
    const Camera2 camera = camera_for({0, 0, 10, 5}, reserved, plot);
    const double left = camera.pixel_x(0) - clamp - plot.x, top = camera.pixel_y(5) - arrow - plot.y;
    const double right = plot.x + plot.width - camera.pixel_x(10),
                 bottom = plot.y + plot.height - camera.pixel_y(0);
    for (const double free : {left, top, right, bottom}) EXPECT_GE(free, -1e-6);
    // No larger scale would fit: one way nothing is left but the margin of 3 % of 10 m.
    EXPECT_NEAR(std::min(left + right, top + bottom), 0.3 * camera.scale, 1);
    EXPECT_EQ(camera.rect.width, plot.width);
}

TEST(Camera, WithoutSymbolsIsAPlainFit) {
    const PixelRect plot{60, 150, 1400, 800};
    const Camera2 camera = camera_for({0, 0, 10, 5}, {}, plot);
    EXPECT_NEAR(camera.scale, 1400 / 10.6, 1e-9);  // 10 m and twice the margin of 3 %
    EXPECT_NEAR(camera.pixel_x(5), 760, 1e-9);
    EXPECT_NEAR(camera.pixel_y(2.5), 550, 1e-9);
}

TEST(Camera, ASmallLoadNeedsLessRoom) {
    const View view;
    const Positions at(plate());
    const SymbolAnchor anchor = find_symbol_anchors(plate(), false, true).at(0);  // pushes down from above
    const Reserved full = reserve(anchor, at.x, at.y, 1, view).at(0),
                   half = reserve(anchor, at.x, at.y, 0.5, view).at(0);
    EXPECT_DOUBLE_EQ(full.room[1], symbol_reach(Symbol::Kind::arrow, view));
    EXPECT_DOUBLE_EQ(half.room[1], full.room[1] / 2);
    EXPECT_EQ(full.room[3], 0);
    EXPECT_DOUBLE_EQ(full.y, 5);  // the upper edge of the uppermost particle
    // Turned round it pulls upward from the same edge.
    EXPECT_DOUBLE_EQ(reserve(anchor, at.x, at.y, -1, view).at(0).room[1], full.room[1]);
}

}  // namespace
}  // namespace hibi
