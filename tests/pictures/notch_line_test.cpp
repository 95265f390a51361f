#include "pictures/notch_line.hpp"

#include <gtest/gtest.h>

namespace hibi {
namespace {

/// 6 x 4 particles at a spacing of 1 m, cut from the left edge to x = 3 between the second and the third row.
Topology notched_plate() {
    Topology t;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 6; ++column) {
            t.reference_position.push_back({column + 0.5, row + 0.5, 0});
            t.spacing.push_back(1);
        }
    }
    t.notches = {{Vec3(-3, 2, 0), Vec3(3, 2, 0)}};
    return t;
}

TEST(NotchLine, LiesWhereTheBodyIsOnBothSides) {
    const std::vector<NotchLine> lines = find_notches(notched_plate());
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NEAR(lines[0].points.front().x(), -0.5, 0.5);  // not from -3, where no particle is near
    EXPECT_EQ(lines[0].points.back(), Vec3(3, 2, 0));
    for (const std::array<int, 2>& sides : lines[0].beside) {
        EXPECT_EQ(std::min(sides[0], sides[1]) / 6, 1);  // second row
        EXPECT_EQ(std::max(sides[0], sides[1]) / 6, 2);  // third row
    }
}

TEST(NotchLine, MovesWithTheMiddleOfItsSides) {
    const Topology t = notched_plate();
    const NotchLine line = find_notches(t).front();
    std::vector<double> x, y;
    for (const Vec3& X : t.reference_position) {
        x.push_back(X.x() + 10);
        y.push_back(X.y() + (X.y() > 2 ? 2 : 0));  // the upper half goes up by 2, the middle by 1
    }
    const Camera2 camera = Camera2::fit(0, 0, 20, 20, {0, 0, 200, 200});
    const Symbol symbol = place_notch(line, t, x, y, camera);
    EXPECT_EQ(symbol.kind, Symbol::Kind::notch);
    EXPECT_NEAR(symbol.points.back()[0], camera.pixel_x(13), 1e-9);
    EXPECT_NEAR(symbol.points.back()[1], camera.pixel_y(3), 1e-9);
}

TEST(NotchLine, EndsWhereItsSidesHaveParted) {
    const Topology t = notched_plate();
    std::vector<double> x, y;
    for (const Vec3& X : t.reference_position) {
        x.push_back(X.x());
        y.push_back(X.y() + (X.y() > 2 ? 4 : 0));
    }
    const Camera2 camera = Camera2::fit(0, 0, 20, 20, {0, 0, 200, 200});
    EXPECT_TRUE(place_notch(find_notches(t).front(), t, x, y, camera).points.empty());
}

TEST(NotchLine, WithoutANotchThereIsNone) {
    Topology t = notched_plate();
    t.notches = {{Vec3(20, 0, 0), Vec3(30, 0, 0)}};
    EXPECT_TRUE(find_notches(t).empty());
}

}  // namespace
}  // namespace hibi
