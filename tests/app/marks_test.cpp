#include "app/marks.hpp"

#include <gtest/gtest.h>

#include "app/recorded_cantilever.hpp"

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
    const std::vector<Mark> marks = find_marks(t, true, true);
    ASSERT_EQ(marks.size(), 1u);
    EXPECT_EQ(marks[0].kind, Symbol::Kind::clamp);
    EXPECT_EQ(marks[0].towards, (Pair{-1, 0}));
    std::vector<int> line = marks[0].particles;
    std::ranges::sort(line);
    EXPECT_EQ(line, column(0));
}

TEST(Marks, SupportsFarApartAreDrawnApart) {
    Topology t = plate();
    t.supports = {{"feet", {0, 1, 8, 9}, {false, true, false}}};
    const std::vector<Mark> marks = find_marks(t, true, false);
    ASSERT_EQ(marks.size(), 2u);
    for (const Mark& mark : marks) {
        EXPECT_EQ(mark.kind, Symbol::Kind::roller);
        EXPECT_EQ(mark.towards, (Pair{0, -1}));
        EXPECT_EQ(mark.particles.size(), 2u);
    }
}

TEST(Marks, ARollerStandsSquareToTheWayItHolds) {
    Topology t = plate();
    t.supports = {{"wall", column(9), {true, false, false}}, {"ceiling", {42, 43, 44}, {false, true, false}}};
    const std::vector<Mark> marks = find_marks(t, true, false);
    ASSERT_EQ(marks.size(), 2u);
    EXPECT_EQ(marks[0].towards, (Pair{1, 0}));
    EXPECT_EQ(marks[1].towards, (Pair{0, 1}));
}

TEST(Marks, AForceAlongAFacePushesOntoItsEnd) {
    const std::vector<Mark> marks = find_marks(plate(), false, true);  // the tip's column, pushed down
    ASSERT_EQ(marks.size(), 1u);
    EXPECT_EQ(marks[0].particles, (std::vector<int>{49}));  // the uppermost
    EXPECT_FALSE(marks[0].pulls);
    EXPECT_EQ(marks[0].towards, (Pair{0, -1}));
}

TEST(Marks, APullBeginsAtTheFaceAndAPushEndsThere) {
    Topology t = plate();
    t.loads[0].direction = Vec3::UnitX();
    EXPECT_TRUE(find_marks(t, false, true).at(0).pulls);
    EXPECT_EQ(find_marks(t, false, true).at(0).particles.size(), 5u);
    t.loads[0].direction = -Vec3::UnitX();
    EXPECT_FALSE(find_marks(t, false, true).at(0).pulls);
}

TEST(Marks, AbsentOnesAreNotDrawn) {
    Topology t = plate();
    EXPECT_TRUE(find_marks(t, false, false).empty());
    t.supports[0].particles.clear();
    t.loads[0].particles.clear();
    EXPECT_TRUE(find_marks(t, true, true).empty());
}

TEST(Marks, RoomIsLeftWhereTheyStand) {
    const View view;
    const std::vector<Mark> marks = find_marks(plate(), true, true);
    const std::array<double, 4> room = room_for(marks, view);  // left, top, right, bottom
    EXPECT_DOUBLE_EQ(room[0], symbol_reach(Symbol::Kind::clamp, view));
    EXPECT_DOUBLE_EQ(room[1], symbol_reach(Symbol::Kind::arrow, view));
    EXPECT_EQ(room[2], 0);
    EXPECT_EQ(room[3], 0);
}

TEST(Marks, SymbolsFollowTheirParticlesAndTurnWithTheLoad) {
    const Mark mark = find_marks(plate(), false, true).at(0);
    const Camera2 camera = Camera2::fit(0, 0, 10, 5, {0, 0, 1000, 500});  // 100 pixels per metre
    std::vector<double> x(50, 0), y(50, 0);
    x[49] = 9;
    y[49] = 3;
    const Symbol down = place_mark(mark, x, y, camera, 0.5, 1);
    EXPECT_EQ(down.points, (std::vector<Pair>{{900, 200}}));
    EXPECT_EQ(down.radius, 50);
    EXPECT_EQ(down.direction, (Pair{0, 1}));  // pixels count downward
    EXPECT_EQ(down.size, 0.5);
    const Symbol up = place_mark(mark, x, y, camera, -0.5, 1);
    EXPECT_EQ(up.direction, (Pair{0, -1}));
    EXPECT_TRUE(up.pulls);
    EXPECT_EQ(up.size, 0.5);
}

TEST(Camera, ShowsTheWindowInsideThePlotAndKeepsRoomForSymbols) {
    const View view;
    const std::vector<Mark> marks = find_marks(plate(), true, true);
    const PixelRect plot{60, 150, 1400, 800};
    const Camera2 camera = camera_for({0, 0, 10, 5}, false, plot, marks, view);
    EXPECT_GE(camera.pixel_x(0) - plot.x, symbol_reach(Symbol::Kind::clamp, view));
    EXPECT_GE(camera.pixel_y(5) - plot.y, symbol_reach(Symbol::Kind::arrow, view));
    EXPECT_LE(camera.pixel_x(10), plot.x + plot.width);
    EXPECT_LE(camera.pixel_y(0), plot.y + plot.height);
    EXPECT_EQ(camera.rect.width, plot.width);
    const Camera2 fixed = camera_for({0, 0, 14, 8}, true, plot, marks, view);
    EXPECT_DOUBLE_EQ(fixed.pixel_x(0), plot.x);
    EXPECT_DOUBLE_EQ(fixed.pixel_y(8), plot.y);
}

}  // namespace
}  // namespace hibi
