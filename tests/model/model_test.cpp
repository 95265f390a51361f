#include "model/model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "support/plates.hpp"

namespace hibi {
namespace {

TEST(Fill, BoxBeginsHalfASpacingInside) {
    const std::vector<Vec<2>> points = fill<2>({Box<2>{{1, 2}, {5, 4}}}, 0.5);
    ASSERT_EQ(points.size(), 8u * 4u);
    EXPECT_EQ(points.front(), Vec<2>(1.25, 2.25));
    EXPECT_EQ(points[1], Vec<2>(1.75, 2.25));  // x runs fastest
    EXPECT_EQ(points.back(), Vec<2>(4.75, 3.75));
}

TEST(Fill, DiscAndRingAreSymmetricAndHaveAboutTheirArea) {
    const Shape<2> disc{Disc<2>{{3, -1}, 2}};
    const Shape<2> ring{Ring<2>{{3, -1}, 1, 2}};
    for (const Shape<2>& shape : {disc, ring}) {
        const std::vector<Vec<2>> points = fill<2>(shape, 0.1);
        Vec<2> sum = Vec<2>::Zero();
        for (const Vec<2>& p : points) sum += p - Vec<2>(3, -1);
        EXPECT_LE(sum.norm(), 1e-9);
        EXPECT_NEAR(0.01 * static_cast<double>(points.size()) / content(shape).measure, 1, 0.02);
    }
    EXPECT_DOUBLE_EQ(content(ring).measure, 3 * std::numbers::pi);
}

TEST(Fill, PolygonEitherWayRoundAndDifference) {
    const Shape<2> triangle{Polygon{{{0, 0}, {4, 0}, {0, 3}}}};
    const Shape<2> reversed{Polygon{{{0, 3}, {4, 0}, {0, 0}}}};
    EXPECT_DOUBLE_EQ(content(triangle).measure, 6);
    EXPECT_DOUBLE_EQ(content(reversed).measure, 6);
    EXPECT_EQ(fill<2>(triangle, 0.1).size(), fill<2>(reversed, 0.1).size());
    EXPECT_NEAR(0.01 * static_cast<double>(fill<2>(triangle, 0.1).size()), 6, 0.2);
    const Shape<2> holed{Difference<2>{{Shape<2>{Box<2>{{0, 0}, {4, 4}}}, Shape<2>{Disc<2>{{2, 2}, 1}}}}};
    EXPECT_NEAR(content(holed).measure / (16 - std::numbers::pi), 1, 1e-3);
    // The upper half of a ring: the box that is taken away is larger than what it takes.
    const Shape<2> arch{Difference<2>{{Shape<2>{Ring<2>{{0, 0}, 4, 5}}, Shape<2>{Box<2>{{-9, -9}, {9, 0}}}}}};
    EXPECT_NEAR(content(arch).measure / (4.5 * std::numbers::pi), 1, 1e-3);
    EXPECT_FALSE(inside<2>(holed, {2, 2}));
    EXPECT_TRUE(inside<2>(holed, {0.5, 0.5}));
    for (const Vec<2>& p : fill<2>(holed, 0.25)) EXPECT_GT((p - Vec<2>(2, 2)).norm(), 1);
}

std::vector<Vec<2>> sorted(std::vector<Vec<2>> points) {
    const auto rounded = [](const Vec<2>& p) {
        return std::pair{std::llround(1e6 * p.y()), std::llround(1e6 * p.x())};
    };
    std::sort(points.begin(), points.end(),
              [&](const Vec<2>& a, const Vec<2>& b) { return rounded(a) < rounded(b); });
    return points;
}

TEST(Fill, AQuarterTurnOfTheLatticeChangesOnlyTheOrder) {
    for (const Shape<2>& shape : {Shape<2>{Box<2>{{1, 2}, {5.5, 4}}}, Shape<2>{Disc<2>{{3, -1}, 2}}}) {
        const std::vector<Vec<2>> straight = sorted(fill<2>(shape, 0.5)),
                                  turned = sorted(fill<2>(shape, 0.5, {.angle = std::numbers::pi / 2}));
        ASSERT_EQ(straight.size(), turned.size());
        for (std::size_t i = 0; i < straight.size(); ++i) EXPECT_LE((straight[i] - turned[i]).norm(), 1e-12);
    }
}

TEST(Fill, ATurnedLatticeCoversTheAreaAndKeepsItsSpacing) {
    const Shape<2> box{Box<2>{{0, 0}, {4.03, 2.01}}}, disc{Disc<2>{{0, 0}, 1.5}};
    for (const Shape<2>& shape : {box, disc}) {
        for (const double degrees : {15, 30, 45, 77, -20}) {
            const std::vector<Vec<2>> points =
                fill<2>(shape, 0.05, {.angle = degrees * std::numbers::pi / 180, .jitter = 0.2});
            EXPECT_NEAR(0.0025 * static_cast<double>(points.size()) / content(shape).measure, 1, 0.02) << degrees;
        }
    }
    const std::vector<Vec<2>> points = fill<2>(box, 0.05, {.angle = 0.3});
    for (const auto& [i, j] : neighbours<2>(points, 0.06))
        EXPECT_NEAR((points[i] - points[j]).norm(), 0.05, 1e-12);
}

TEST(Fill, JitterFollowsItsSeedAndTheCellAlone) {
    const Shape<2> box{Box<2>{{0, 0}, {4, 2}}}, wider{Box<2>{{0, 0}, {6, 3}}};
    const Lattice jittered{.jitter = 0.2, .seed = 7};
    const std::vector<Vec<2>> straight = fill<2>(box, 0.5), points = fill<2>(box, 0.5, jittered);
    EXPECT_EQ(points, fill<2>(box, 0.5, jittered));
    EXPECT_NE(points, fill<2>(box, 0.5, {.jitter = 0.2, .seed = 8}));
    double largest = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        largest = std::max(largest, (points[i] - straight[i]).cwiseAbs().maxCoeff());
    EXPECT_LE(largest, 0.1);
    EXPECT_GT(largest, 0.08);
    const std::vector<Vec<2>> more = fill<2>(wider, 0.5, jittered);
    EXPECT_EQ(points[8], more[12]);  // second row, first column of both
}

TEST(Neighbours, GridFindsWhatTheDoubleLoopFinds) {
    std::mt19937 random(5);
    std::vector<Vec<2>> points(700);
    for (Vec<2>& p : points) p = {static_cast<double>(random()) / 4e8, static_cast<double>(random()) / 4e8};
    for (const double radius : {0.3, 1.0, 4.0, 30.0}) {
        std::vector<std::pair<int, int>> expected;
        for (int i = 0; i < 700; ++i)
            for (int j = i + 1; j < 700; ++j)
                if ((points[j] - points[i]).squaredNorm() < radius * radius) expected.push_back({i, j});
        ASSERT_FALSE(expected.empty());
        EXPECT_EQ(neighbours<2>(points, radius), expected);
    }
}

TEST(Connect, InteriorParticleHasTwelveNeighboursAt21) {
    const Model<2> model = test::plate(9, 9, 1);
    const int middle = 4 * 9 + 4;
    EXPECT_EQ(model.bonds.start[middle + 1] - model.bonds.start[middle], 12);
    // rows and columns at 1 and 2, both diagonals, each bond once
    EXPECT_EQ(model.bonds.count(), 2 * 9 * 8 + 2 * 9 * 7 + 2 * 8 * 8);
    for (int b = 0; b < model.bonds.count(); ++b) EXPECT_LT(model.bonds.first[b], model.bonds.second[b]);
}

TEST(Connect, NotchCutsWhatItCrossesAndWhatItsEndTouches) {
    // Along y = 2 between the second and third row, from the left edge to x = 2.5, where a particle column
    // stands: its end touches the vertical bonds of that column.
    const std::vector<Notch<2>> notch = {{.name = "cut", .points = {{-1, 2}, {2.5, 2}}}};
    Model<2> model = test::plate(6, 4, 1);
    const int before = model.bonds.count();
    const std::vector<int> cut = connect<2>(model, notch);
    EXPECT_EQ(cut[0], before - model.bonds.count());
    EXPECT_EQ(model.bonds_cut, cut[0]);
    for (int b = 0; b < model.bonds.count(); ++b) {
        const Vec<2> X = model.particles.reference_position[model.bonds.first[b]];
        const Vec<2> Y = model.particles.reference_position[model.bonds.second[b]];
        if ((X.y() - 2) * (Y.y() - 2) < 0) {
            EXPECT_GT(X.x() + (2 - X.y()) / (Y.y() - X.y()) * (Y.x() - X.x()), 2.5);
        }
    }
    EXPECT_EQ(cut[0],
              3 + 6 + 4);  // across y = 2: 3 upright at 1, 2 x 3 at 2, and 2 diagonals at x = 1 and at 2
}

TEST(Connect, BodiesBondOnlyWhereTheyAreBondedTo) {
    for (const bool bonded : {false, true}) {
        Model<2> model;
        model.materials = {test::concrete()};
        add_body<2>(model, {.name = "left", .shape = {Box<2>{{0, 0}, {3, 2}}}, .spacing = 1});
        Body<2> right{.name = "right", .shape = {Box<2>{{3, 0}, {6, 2}}}, .spacing = 1};
        if (bonded) right.bonded_to = {0};
        add_body<2>(model, right);
        connect<2>(model, {});
        int across = 0;
        for (int b = 0; b < model.bonds.count(); ++b)
            across +=
                model.particles.body[model.bonds.first[b]] != model.particles.body[model.bonds.second[b]];
        if (bonded) {
            EXPECT_EQ(model.bonds.count(), test::plate(6, 2, 1).bonds.count());
        } else {
            EXPECT_EQ(across, 0);
        }
    }
}

}  // namespace
}  // namespace hibi
