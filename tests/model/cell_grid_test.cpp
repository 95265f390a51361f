#include "model/cell_grid.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace hibi {
namespace {

template <int Dim>
std::vector<Vec<Dim>> random_points(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-3, 5);
    std::vector<Vec<Dim>> points(count);
    for (Vec<Dim>& p : points)
        for (int a = 0; a < Dim; ++a) p[a] = place(random);
    return points;
}

template <int Dim>
void finds_what_the_double_loop_finds(double cell, double radius) {
    const std::vector<Vec<Dim>> points = random_points<Dim>(300, 7);
    CellGrid<Dim> grid;
    grid.build(points, cell);
    std::size_t most = 0;
    for (int i = 0; i < grid.count(); ++i) {
        std::set<int> near, expected;
        grid.each_near(i, radius, [&](int j) { EXPECT_TRUE(near.insert(j).second) << j << " seen twice"; });
        for (int j = 0; j < grid.count(); ++j)
            if (j != i && (points[j] - points[i]).norm() < radius) expected.insert(j);
        EXPECT_EQ(near, expected);
        most = std::max(most, near.size());
    }
    EXPECT_GT(most, 2u);
}

TEST(CellGrid, FindsWhatTheDoubleLoopFindsInThePlaneAndInSpace) {
    for (const double cell : {0.3, 0.8, 2.0}) {
        finds_what_the_double_loop_finds<2>(cell, 0.8);
        finds_what_the_double_loop_finds<3>(cell, 1.1);
    }
}

TEST(CellGrid, LooksAroundAnyPlaceBesideThePointsToo) {
    CellGrid<3> grid;
    grid.build({{0, 0, 0}, {1, 0, 0}, {0, 0, 9}}, 0.5);
    std::vector<int> found;
    grid.each_near(Vec<3>(-0.3, 0, 0), 0.5, [&](int j) { found.push_back(j); });
    EXPECT_EQ(found, std::vector<int>{0});
}

TEST(CellGrid, OfNoPointsFindsNone) {
    CellGrid<2> grid;
    grid.build({}, 1);
    grid.each_near(Vec<2>(0, 0), 1, [&](int) { ADD_FAILURE(); });
}

TEST(CellGrid, VisitsInTheSameOrderEachTimeItIsBuilt) {
    const std::vector<Vec<2>> points = random_points<2>(200, 3);
    const auto visits = [&] {
        CellGrid<2> grid;
        grid.build(points, 0.7);
        std::vector<int> order;
        for (int i = 0; i < grid.count(); ++i) grid.each_near(i, 0.7, [&](int j) { order.push_back(j); });
        return order;
    };
    EXPECT_EQ(visits(), visits());
}

}  // namespace
}  // namespace hibi
