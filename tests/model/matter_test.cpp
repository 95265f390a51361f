#include "model/matter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/plates.hpp"

namespace hibi {
namespace {

using Points = std::vector<Vec<2>>;

Shape<2> box(Vec<2> low, Vec<2> high) { return {Box<2>{low, high}}; }
Shape<2> disc(Vec<2> centre, double radius) { return {Disc<2>{centre, radius}}; }
Shape<2> polygon(const Points& corners) { return {Polygon{corners}}; }
Shape<2> less(const Shape<2>& whole, const Shape<2>& hole) { return {Difference<2>{{whole, hole}}}; }

/// A body of spacing 1.
Body<2> body(const Shape<2>& shape, const Lattice& lattice = {}) {
    return {.name = "body", .shape = shape, .spacing = 1, .lattice = lattice};
}
Model<2> connected(const std::vector<Body<2>>& bodies, double influence = 2.1,
                   const std::vector<Notch<2>>& notches = {}) {
    Model<2> model;
    model.materials = {test::concrete()};
    model.influence = influence;
    for (const Body<2>& body : bodies) add_body<2>(model, body);
    connect<2>(model, notches);
    return model;
}

double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }
bool crosses(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& d) {
    return cross(b - a, c - a) * cross(b - a, d - a) < 0 && cross(d - c, a - c) * cross(d - c, b - c) < 0;
}
double distance(const Vec<2>& X, const Vec<2>& a, const Vec<2>& b) {
    const double t = std::clamp((X - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (X - a - t * (b - a)).norm();
}
/// Bonds that cross a line further than `beyond` from its first point; they go by the cells' centres.
int bonds_across(const Model<2>& model, const Vec<2>& from, const Vec<2>& to, double beyond = 0) {
    int count = 0;
    for (int b = 0; b < model.bonds.count(); ++b) {
        const Vec<2>&X = model.cell_centre(model.bonds.first[b]),
              &Y = model.cell_centre(model.bonds.second[b]);
        count += crosses(X, Y, from, to) && distance(from, X, Y) > beyond;
    }
    return count;
}
int bonds_between_bodies(const Model<2>& model) {
    int count = 0;
    for (int b = 0; b < model.bonds.count(); ++b)
        count += model.particles.body[model.bonds.first[b]] != model.particles.body[model.bonds.second[b]];
    return count;
}

/// A strip about the line from `from` to `to`.
Shape<2> strip(const Vec<2>& from, const Vec<2>& to, double width) {
    const Vec<2> along = (to - from).normalized(), half = width / 2 * Vec<2>(-along.y(), along.x());
    return polygon({from - half, to - half, to + half, from + half});
}

TEST(Matter, NoBondCrossesASlotOfAnyWidthAndDirection) {
    const Shape<2> whole = box({0, 0}, {20, 20});
    for (const double degrees : {0.0, 10.0, 30.0, 45.0, 77.0, 90.0})
        for (const double width : {0.01, 0.3, 0.5, 1.0, 1.5, 2.0})
            for (const Lattice& lattice : {Lattice{}, Lattice{.angle = 0.4}, Lattice{.jitter = 0.3}})
                for (const double influence : {2.1, 3.1}) {
                    const double angle = degrees * std::numbers::pi / 180;
                    // It ends in the body at one side, and leaves it at the other.
                    const Vec<2> along(std::cos(angle), std::sin(angle)), middle(10.03, 9.96);
                    const Vec<2> tip = middle - 4 * along, mouth = middle + 20 * along;
                    const Model<2> model =
                        connected({body(less(whole, strip(tip, mouth, width)), lattice)}, influence);
                    // Next to its end, whose corners are half its width away, a bond may bend round it.
                    EXPECT_EQ(bonds_across(model, tip, mouth, 0.251 + width / 2), 0)
                        << degrees << " deg, " << width << ", influence " << influence;
                    if (width < 1.5) {
                        EXPECT_GT(model.bonds_over_gaps, 0);
                    }
                }
}

TEST(Matter, ASlotIsAsOpenAsANotchInIt) {
    const Shape<2> slotted = less(box({0, 0}, {16, 9}), box({2, 4}, {16, 5}));
    const Shape<2> u = polygon({{0, 0}, {16, 0}, {16, 4}, {2, 4}, {2, 5}, {16, 5}, {16, 9}, {0, 9}});
    const Notch<2> notch{.name = "cut", .points = {{2, 4.5}, {16, 4.5}}};
    for (const Shape<2>& shape : {slotted, u}) {
        const Model<2> open = connected({body(shape)});
        const Model<2> cut = connected({body(shape)}, 2.1, {notch});
        EXPECT_EQ(open.bonds_over_gaps, 14);
        EXPECT_EQ(open.bonds.first, cut.bonds.first);
        EXPECT_EQ(open.bonds.second, cut.bonds.second);
        EXPECT_EQ(cut.bonds_cut, 14);
    }
}

TEST(Matter, APolygonThatTouchesItselfIsSlitThere) {
    for (const auto& [tip, mouth] :
         {std::pair{Vec<2>(2.2, 5), Vec<2>(16, 5)}, {Vec<2>(2.2, 3.1), Vec<2>(16, 7.3)}}) {
        const Shape<2> slit = polygon({{0, 0}, {16, 0}, mouth, tip, mouth, {16, 9}, {0, 9}});
        const Model<2> open = connected({body(slit)});
        const Model<2> cut =
            connected({body(box({0, 0}, {16, 9}))}, 2.1, {{.name = "cut", .points = {tip, mouth}}});
        EXPECT_EQ(open.particles.count(), 16 * 9);
        EXPECT_EQ(bonds_across(open, tip, mouth, 0.251), 0);
        EXPECT_GE(open.bonds_over_gaps, cut.bonds_cut - 4);  // next to its tip
        EXPECT_LE(open.bonds_over_gaps, cut.bonds_cut);
    }
    // Through the centres of a row: as by a notch, they lose their bonds to both sides, at any size.
    for (const double scale : {1.0, 0.1, 0.3}) {
        Points corners;
        for (const Vec<2>& c : Points{{0, 0}, {16, 0}, {16, 4.5}, {2.2, 4.5}, {16, 4.5}, {16, 9}, {0, 9}})
            corners.push_back(scale * c);
        Body<2> slit = body(polygon(corners));
        slit.spacing = scale;
        const Model<2> model = connected({slit});
        const auto on_slit = [&](int i) {
            const Vec<2> X = model.particles.reference_position[i] / scale;
            return std::abs(X.y() - 4.5) < 0.1 && X.x() > 2.4;
        };
        int along = 0, off = 0;
        for (int b = 0; b < model.bonds.count(); ++b) {
            const int on = on_slit(model.bonds.first[b]) + on_slit(model.bonds.second[b]);
            along += on == 2;
            const double rise = std::abs(model.bond_vectors[b].y()) / scale;
            off += on == 1 && rise > 0.1;
        }
        EXPECT_EQ(along, 13 + 12) << scale;
        EXPECT_LE(off, 4) << scale;  // of the centre next to the tip
    }
}

TEST(Matter, ACutOpensARingAndADisc) {
    for (const Shape<2>& round : {Shape<2>{Ring<2>{{0, 0}, 6, 10}}, disc({0, 0}, 10)})
        for (const double width : {0.2, 1.0, 1.9}) {
            const Model<2> model = connected({body(less(round, box({1, -width / 2}, {11, width / 2})))});
            EXPECT_EQ(bonds_across(model, {1.5, 0}, {11, 0}), 0) << width;
            EXPECT_GT(bonds_across(model, {-11, 0}, {-1, 0}), 0);
        }
}

TEST(Matter, BondsRoundAHoleAndAlongRoughSidesStay) {
    for (const Lattice& lattice : {Lattice{}, Lattice{.angle = 0.3}, Lattice{.jitter = 0.3}})
        for (const auto& [influence, radius] : std::vector<std::pair<double, double>>{
                 {1.5, 2}, {2.1, 3}, {2.1, 5}, {2.1, 10}, {3.1, 6}, {3.1, 20}}) {
            for (const Vec<2>& centre : {Vec<2>(0, 0), Vec<2>(0.5, 0.5), Vec<2>(0.2, 0.37)}) {
                const Shape<2> plate = box({-30, -30}, {30, 30});
                Points circle;
                for (int k = 0; k < 100; ++k)
                    circle.push_back(centre + radius * Vec<2>(std::cos(k * std::numbers::pi / 50),
                                                              std::sin(k * std::numbers::pi / 50)));
                for (const Shape<2>& hole : {disc(centre, radius), polygon(circle)})
                    EXPECT_EQ(connected({body(less(plate, hole), lattice)}, influence).bonds_over_gaps, 0)
                        << "influence " << influence << ", radius " << radius;
                EXPECT_EQ(connected({body({Ring<2>{centre, radius, radius + 8}}, lattice)}, influence)
                              .bonds_over_gaps,
                          0)
                    << "influence " << influence << ", radius " << radius;
            }
        }
    // Teeth of a fifth of a spacing, as a traced picture has them.
    Points rough{{0, 0}, {20, 0}};
    for (double x = 20; x > 0.1; x -= 0.5) {
        rough.push_back({x, 10});
        rough.push_back({x - 0.25, 10});
        rough.push_back({x - 0.25, 9.8});
        rough.push_back({x - 0.5, 9.8});
    }
    for (const double angle : {0.0, 0.3}) {
        const Model<2> model = connected({body(polygon(rough), {.angle = angle})}, 3.1);
        EXPECT_EQ(model.bonds_over_gaps, 0);
    }
}

TEST(Matter, ABondCutsAReEntrantCornerByNoMoreThanAQuarterOfASpacing) {
    const Points corners{{0, 0}, {12, 0}, {12, 5}, {5, 5}, {5, 12}, {0, 12}};
    Points reversed(corners.rbegin(), corners.rend());
    const Shape<2> glued = less(box({0, 0}, {12, 12}), box({5, 5}, {13, 13}));
    for (const Shape<2>& shape : {polygon(corners), polygon(reversed), glued}) {
        EXPECT_EQ(connected({body(shape)}, 2.1).bonds_over_gaps, 0);  // diagonals through the corner touch it
        // From (4.5, 6.5) to (6.5, 4.5): the corner is 0.71 away. To (5.5, 4.5) it is 0.22, and bonds bend by
        // that.
        EXPECT_EQ(connected({body(shape)}, 3.1).bonds_over_gaps, 1);
    }
    // A centre on the corner itself keeps its bonds, at any size of the numbers; between its two neighbours
    // on the sides is empty space.
    for (const double scale : {1.0, 0.1, 0.3}) {
        Points on;
        for (const Vec<2>& c : Points{{0, 0}, {11, 0}, {11, 4.5}, {4.5, 4.5}, {4.5, 11}, {0, 11}})
            on.push_back(scale * c);
        Body<2> l = body(polygon(on));
        l.spacing = scale;
        EXPECT_EQ(connected({l}, 2.1).bonds_over_gaps, 1) << scale;
    }
}

TEST(Matter, BodiesAreGluedAcrossACommonSideAndHalfASpacingAtMost) {
    const auto pair = [](double gap) {
        Body<2> right = body(box({6 + gap, 0}, {12 + gap, 8}));
        right.bonded_to = {0};
        return connected({body(box({0, 0}, {6, 8})), right});
    };
    const int whole = test::plate(12, 8, 1).bonds.count();
    EXPECT_EQ(pair(0).bonds.count(), whole);
    EXPECT_GT(bonds_between_bodies(pair(0.45)), 8 * 1);
    EXPECT_EQ(pair(0.45).bonds_over_gaps, 0);
    EXPECT_EQ(bonds_between_bodies(pair(0.55)), 0);
    EXPECT_EQ(bonds_between_bodies(pair(1)), 0);
    EXPECT_GT(pair(0.55).bonds_over_gaps, 0);
}

TEST(Matter, BodiesGluedToAWholeHaveTheBondsOfTheWhole) {
    for (const double influence : {2.1, 3.1}) {
        const int whole = connected({body(box({0, 0}, {20, 20}))}, influence).bonds.count();
        // A core in a hole: square, then round with the lattice of the plate.
        for (const double half : {0.5, 1.5, 4.5}) {
            const Vec<2> low = Vec<2>::Constant(9.5 - half), high = Vec<2>::Constant(9.5 + half);
            Body<2> core = body(box(low, high));
            core.bonded_to = {0};
            EXPECT_EQ(
                connected({body(less(box({0, 0}, {20, 20}), box(low, high))), core}, influence).bonds.count(),
                whole)
                << half;
        }
        for (const double radius : {1.2, 3.0, 5.0}) {
            Body<2> core = body(disc({10, 10}, radius));
            core.bonded_to = {0};
            EXPECT_EQ(connected({body(less(box({0, 0}, {20, 20}), disc({10, 10}, radius))), core}, influence)
                          .bonds.count(),
                      whole)
                << radius;
        }
        // Three layers, each bonded to the others, the middle one thinner than the influence.
        Body<2> middle = body(box({0, 9}, {20, 10})), top = body(box({0, 10}, {20, 20}));
        middle.bonded_to = {0};
        top.bonded_to = {0, 1};
        EXPECT_EQ(connected({body(box({0, 0}, {20, 9})), middle, top}, influence).bonds.count(), whole);
        // A plate in a frame of two layers: each bond across the plate's layer belongs to the frame.
        Body<2> core = body(box({5, 9}, {20, 10}));
        core.bonded_to = {0};
        EXPECT_EQ(connected({body(less(box({0, 0}, {20, 20}), box({5, 9}, {20, 10}))), core}, influence)
                      .bonds.count(),
                  whole);
        // A slot filled by a body that is not bonded to it stays open.
        core.bonded_to = {};
        const Model<2> apart =
            connected({body(less(box({0, 0}, {20, 20}), box({5, 9}, {20, 10}))), core}, influence);
        EXPECT_GT(apart.bonds_over_gaps, 0);
    }
}

TEST(Fill, ASideThroughCentresIsTreatedAlikeAllRound) {
    const Points diamond{{0, -8}, {8, 0}, {0, 8}, {-8, 0}};
    for (const Vec<2>& shift : {Vec<2>(0, 0), Vec<2>(0.3, 0.7), Vec<2>(1e5 / 3, -1e6 / 7)})
        for (const double scale : {1.0, 0.1, 0.7}) {
            Points corners;
            for (const Vec<2>& c : diamond) corners.push_back(scale * (c + shift));
            const Points points = fill<2>(polygon(corners), scale);
            EXPECT_EQ(points.size(), 144u) << scale;  // all 32 centres on the sides are in
            Vec<2> sum = Vec<2>::Zero();
            for (const Vec<2>& p : points) sum += p / scale - shift;
            EXPECT_LT(sum.norm(), 1e-6);
        }
    // A box, a disc and a ring, whose sides pass through centres, at a tenth of the size.
    for (const double scale : {1.0, 0.1, 0.3, 1e-5}) {
        EXPECT_EQ(fill<2>(box({0, 0}, {3.5 * scale, 6.5 * scale}), scale).size(), 4u * 7u) << scale;
        const double r = scale * std::hypot(3.5, 2.5);
        EXPECT_EQ(fill<2>(disc({scale / 3, 0}, r), scale).size(),
                  fill<2>(disc({0, 0}, r + 1e-3 * scale), scale).size());
        const std::size_t hole = fill<2>({Ring<2>{{scale / 3, 0}, r, 9 * scale}}, scale).size();
        EXPECT_EQ(hole, fill<2>({Ring<2>{{0, 0}, r - 1e-3 * scale, 9 * scale}}, scale).size());
        // What is taken away takes its sides along: a body fits into its hole.
        const Shape<2> core = box({1.5 * scale, 1.5 * scale}, {4.5 * scale, 4.5 * scale});
        EXPECT_EQ(fill<2>(less(box({0, 0}, {6 * scale, 6 * scale}), core), scale).size(), 36u - 16u) << scale;
    }
}

TEST(AddBody, TwoBodiesShareTheCentresOnTheirCommonSide) {
    for (const double scale : {1.0, 0.1})
        for (const double jitter : {0.0, 0.2}) {
            Body<2> lower =
                body(polygon({{0, 0}, {10 * scale, 0}, {10 * scale, 10 * scale}}), {.jitter = jitter});
            Body<2> upper =
                body(polygon({{0, 0}, {10 * scale, 10 * scale}, {0, 10 * scale}}), {.jitter = jitter});
            lower.spacing = upper.spacing = scale;
            upper.bonded_to = {0};
            const Model<2> model = connected({lower, upper});
            EXPECT_EQ(model.particles.count(), 100);
            EXPECT_EQ(model.bodies[0].end, 55);  // with the diagonal
            for (const double r : model.bonds.rest_length) EXPECT_GT(r, 0.3 * scale);
            if (jitter == 0) {
                EXPECT_EQ(model.bonds.count(), test::plate(10, 10, 1).bonds.count());
            }
        }
}

TEST(Content, AreaAndCentroidOfShapes) {
    const auto near = [](const Shape<2>& shape, double measure, const Vec<2>& centroid, double error) {
        const Content<2> found = content(shape);
        EXPECT_NEAR(found.measure / measure, 1, error);
        EXPECT_LT((found.centroid - centroid).norm(), error * std::sqrt(measure));
    };
    constexpr double pi = std::numbers::pi;
    const Vec<2> far(1e6, -3e6);
    near(box({1, 2}, {4, 4}), 6, {2.5, 3}, 1e-12);
    near({Ring<2>{{1, 2}, 1, 2}}, 3 * pi, {1, 2}, 1e-12);
    near(polygon({far, far + Vec<2>(6, 0), far + Vec<2>(0, 3)}), 9, far + Vec<2>(2, 1), 1e-9);
    near(less(box({0, 0}, {4, 4}), box({2, -1}, {9, 9})), 8, {1, 2}, 1e-9);
    near(less(box({0, 0}, {4, 4}), disc({1, 2}, 0.5)), 16 - pi / 4, {(32 - pi / 4) / (16 - pi / 4), 2}, 2e-6);
    // The upper half of a ring; a corner that a disc takes from a box; holes that overlap.
    near(less({Ring<2>{{0, 0}, 4, 5}}, box({-9, -9}, {9, 0})), 4.5 * pi,
         {0, 2. / 3 * (125 - 64) / (4.5 * pi)}, 2e-6);
    near(less(box({0, 0}, {2, 2}), disc({0, 0}, 1)), 4 - pi / 4,
         Vec<2>::Constant((4 - 1. / 3) / (4 - pi / 4)), 2e-6);
    near(
        {Difference<2>{{box({0, 0}, {4, 4}), disc({2, 2}, 1), disc({2, 2}, 1), box({1.9, 1.9}, {2.1, 2.1})}}},
        16 - pi, {2, 2}, 2e-6);
}

}  // namespace
}  // namespace hibi
