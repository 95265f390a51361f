#include "measure/cracks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/plates.hpp"

namespace hibi {
namespace {

using test::plate;

Model<2> plate_with(int columns, int rows, double spacing, double influence) {
    Model<2> model;
    model.materials = {test::concrete()};
    model.influence = influence;
    add_body<2>(model, {.name = "plate",
                        .shape = {Box<2>{{0, 0}, {columns * spacing, rows * spacing}}},
                        .spacing = spacing});
    connect<2>(model, {});
    return model;
}

/// The intact bonds that pass from one side to the other of the line through `point` with normal `n`, between
/// `from` and `to` along the line, each counted where its middle is nearest to.
std::vector<int> crossing(const Model<2>& model, const State<2>& state, const Vec<2>& point, double angle, double from, double to) {
    const Vec<2> along(std::cos(angle), std::sin(angle)), n(-along.y(), along.x());
    std::vector<int> found;
    for (int b = 0; b < model.bonds.count(); ++b) {
        if (!state.is_intact(b)) continue;
        const Vec<2> first = model.particles.reference_position[model.bonds.first[b]] - point;
        const Vec<2> second = model.particles.reference_position[model.bonds.second[b]] - point;
        const double s = first.dot(n), t = second.dot(n);
        if ((s > 0) == (t > 0)) continue;
        const double place = along.dot(first + s / (s - t) * (second - first));
        if (place >= from && place < to) found.push_back(b);
    }
    return found;
}

void cut(const Model<2>& model, State<2>& state, Cracks<2>& cracks, const std::vector<int>& bonds,
         double time) {
    for (const int b : bonds) state.broken_at[b] = time;
    cracks.grow(model, bonds, time);
}

TEST(CrackLength, CutAlongTheLatticeCountsAsItsLengthForEveryInfluence) {
    for (const double influence : {1.5, 2.1, 2.5, 3.1}) {
        for (const double angle : {0.0, std::numbers::pi / 2}) {
            const Model<2> model = plate_with(60, 60, 0.01, influence);
            State<2> state = initial_state(model);
            Cracks<2> cracks(model);
            // Between two rows, well inside the plate, and from where no bond crosses to where none does.
            cut(model, state, cracks, crossing(model, state, {0.3, 0.3}, angle, -0.2012, 0.1988), 1);
            EXPECT_NEAR(cracks.read(1).length, 0.4, 1e-12) << influence;
        }
    }
}

TEST(CrackLength, BiasOfObliqueCracksIsWhatIsStated) {
    // In per cent at 0, 15, 30 and 45 degrees: from the sum of weight * |b . n| over the bonds of an infinite
    // lattice, computed apart from the program. What is cut of a finite lattice scatters by one spacing.
    const auto bias = [](double influence, double degrees) {
        const Model<2> model = plate_with(200, 200, 0.01, influence);
        State<2> state = initial_state(model);
        Cracks<2> cracks(model);
        cut(model, state, cracks, crossing(model, state, {1.0003, 1.0001}, degrees * std::numbers::pi / 180, -0.8, 0.8), 1);
        return 100 * (cracks.read(1).length / 1.6 - 1);
    };
    EXPECT_NEAR(bias(2.1, 15), 7.3, 0.7);
    EXPECT_NEAR(bias(2.1, 30), 7.3, 0.7);
    EXPECT_NEAR(bias(2.1, 45), 0, 0.7);
    EXPECT_NEAR(bias(2.1, 22.5), 8.2, 0.7);
}

TEST(CrackLength, NotchesDoNotCount) {
    const Model<2> model = plate(20, 20, 1, test::concrete(), Assumption::plane_stress,
                           {{.name = "slit", .points = {{0, 10}, {10, 10}}}});
    ASSERT_GT(model.bonds_cut, 0);
    Cracks<2> cracks(model);
    cracks.grow(model, {}, 1);
    EXPECT_EQ(cracks.read(1).length, 0);
    EXPECT_FALSE(cracks.read(1).tip);
    EXPECT_EQ(cracks.read(1).speed, 0);
}

/// A crack along the middle row from x = 10, let grow by `steps` steps at `speed` (m/s), a step every 0.1 s.
struct Growing {
    Model<2> model = plate(100, 12, 1);
    State<2> state = initial_state(model);
    Cracks<2> cracks{model};
    double time = 0, end = 10;
    void grow(double speed, int steps) {
        for (int k = 0; k < steps; ++k) {
            time += 0.1;
            const double next = end + 0.1 * speed;
            cut(model, state, cracks, crossing(model, state, {0, 6}, 0, end, next), time);
            end = next;
        }
    }
};

TEST(CrackSpeed, CrackAtConstantSpeedShowsNoStepsOfTheSpacing) {
    Growing crack;
    crack.grow(2, 100);  // a spacing every five steps; ten spacings are behind it
    for (int k = 0; k < 100; ++k) {
        crack.grow(2, 1);
        EXPECT_NEAR(crack.cracks.read(crack.time).speed, 2, 0.04);
    }
    EXPECT_NEAR(crack.cracks.top_speed(), 2, 0.06);
}

TEST(CrackSpeed, ChangeIsSeenWithinTenSpacings) {
    Growing crack;
    crack.grow(2, 100);
    crack.grow(1, 110);
    EXPECT_NEAR(crack.cracks.read(crack.time).speed, 1, 0.02);
}

TEST(CrackSpeed, CrackThatStopsIsSeenToSlowDown) {
    Growing crack;
    crack.grow(2, 100);
    const double window = 10 / 2.0;  // seconds for ten spacings
    EXPECT_NEAR(crack.cracks.read(crack.time + window).speed, 1, 0.15);
    EXPECT_LT(crack.cracks.read(crack.time + 100 * window).speed, 0.03);
}

TEST(CrackSpeed, CrackOfAFewSpacingsHasNoneYet) {
    Growing crack;
    crack.grow(2, 20);  // four spacings
    EXPECT_EQ(crack.cracks.read(crack.time).speed, 0);
}

TEST(CrackSpeed, RowThatBreaksAtOnceIsNoSpeed) {
    Growing crack;
    crack.grow(2, 100);
    crack.grow(200, 1);  // twenty spacings in one step
    EXPECT_NEAR(crack.cracks.read(crack.time).tip->x(), 50, 1);
    EXPECT_EQ(crack.cracks.read(crack.time).speed, 0);
    EXPECT_LT(crack.cracks.top_speed(), 2.1);
}

TEST(CrackTip, IsTheFarthestBreakAndNotTheLastOne) {
    Growing crack;
    crack.grow(2, 100);
    const Vec3 before = *crack.cracks.read(crack.time).tip;
    EXPECT_NEAR(before.x(), 30, 1);
    EXPECT_NEAR(before.y(), 6, 1);
    // a splinter half-way along the flank
    cut(crack.model, crack.state, crack.cracks, crossing(crack.model, crack.state, {20, 7}, std::numbers::pi / 2, 0, 2), crack.time);
    EXPECT_EQ(*crack.cracks.read(crack.time).tip, before);
}

TEST(CrackTip, OfTwoEqualCracksOneStaysTheLeader) {
    // Mirror images of each other about y = 20, growing turn by turn.
    const Model<2> model = plate(60, 40, 1);
    State<2> state = initial_state(model);
    Cracks<2> cracks(model);
    double length = 0;
    for (int k = 0; k < 30; ++k) {
        for (const double y : {10.0, 30.0}) cut(model, state, cracks, crossing(model, state, {0, y}, 0, k, k + 1), k);
        EXPECT_NEAR(cracks.read(k).tip->y(), 10, 1) << k;
        EXPECT_GT(cracks.read(k).length, length);
        length = cracks.read(k).length;
    }
    EXPECT_NEAR(length, 60, 1.2);  // both count; at the left edge no bond reaches in from outside
    // ... until the other is really longer
    cut(model, state, cracks, crossing(model, state, {0, 30}, 0, 30, 34), 31);
    EXPECT_NEAR(cracks.read(31).tip->y(), 30, 1);
}

TEST(CrackTip, CracksThatMeetBecomeOneAndTheirMeetingIsNoSpeed) {
    const Model<2> model = plate(100, 20, 1);
    State<2> state = initial_state(model);
    Cracks<2> cracks(model);
    for (int k = 0; k < 20; ++k) cut(model, state, cracks, crossing(model, state, {0, 10}, 0, 10 + k, 11 + k), k);
    cut(model, state, cracks, crossing(model, state, {0, 10}, 0, 34, 50), 20);  // another ahead of it, shorter
    EXPECT_NEAR(cracks.read(20).tip->x(), 30, 1);
    cut(model, state, cracks, crossing(model, state, {0, 10}, 0, 30, 34), 21);
    EXPECT_NEAR(cracks.read(21).tip->x(), 50, 1);
    EXPECT_LT(cracks.top_speed(), 1.1);
    EXPECT_EQ(cracks.read(21).speed, 0);
}

TEST(Fragments, BodyCutTwiceIsThreePiecesOfKnownMass) {
    const Model<2> model = plate(40, 10, 0.5);
    State<2> state = initial_state(model);
    ASSERT_EQ(find_fragments(model, state).count, 1);
    for (const double x : {5.0, 17.5})
        for (const int b : crossing(model, state, {x, 0}, std::numbers::pi / 2, -100, 100))
            state.broken_at[b] = 1;
    const Fragments f = find_fragments(model, state);
    EXPECT_EQ(f.count, 3);
    EXPECT_NEAR(f.largest, 2300 * 12.5 * 5, 1e-6);  // the middle one, 12.5 m x 5 m, 1 m thick
    EXPECT_EQ(f.debris, 0);
}

TEST(Fragments, LoneParticlesAreDebrisAndPairsAreNot) {
    const Model<2> model = plate(40, 10, 0.5);
    State<2> state = initial_state(model);
    const auto isolate = [&](std::vector<int> group) {
        for (int b = 0; b < model.bonds.count(); ++b) {
            const auto in = [&](int i) { return std::find(group.begin(), group.end(), i) != group.end(); };
            if (in(model.bonds.first[b]) != in(model.bonds.second[b])) state.broken_at[b] = 1;
        }
    };
    isolate({100});
    isolate({200});
    isolate({250, 251});
    const Fragments f = find_fragments(model, state);
    EXPECT_EQ(f.count, 2);
    EXPECT_NEAR(f.debris, 2 * 2300 * 0.25, 1e-9);
    EXPECT_NEAR(f.largest, 396 * 2300 * 0.25, 1e-6);
}

TEST(Fragments, NothingHoldsAPulverisedBodyTogether) {
    const Model<2> model = plate(8, 8, 1);
    State<2> state = initial_state(model);
    state.broken_at.assign(model.bonds.count(), 0);
    const Fragments f = find_fragments(model, state);
    EXPECT_EQ(f.count, 0);
    EXPECT_EQ(f.largest, 0);
    EXPECT_NEAR(f.debris, 64 * 2300, 1e-6);
}

}  // namespace
}  // namespace hibi
