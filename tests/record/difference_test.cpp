#include "record/difference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "record/example.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;
constexpr double never = std::numeric_limits<double>::infinity();

/// Three particles in a row, pulled for 0.3 s in steps of 1 ms, a state every tenth.
struct Pulled {
    Topology topology = example::topology();
    std::array<double, 2> broken_at{never, 0.15};
    double shift = 0, shift_from = 0.1;  ///< of one particle (m), from so late (s)
    double shift_rate = 0;               ///< by how much it grows from then on (m/s)
    int shifted = 1;
    double load = 1;                 ///< factor
    double bump = 0, bump_at = 0.1;  ///< added to the load (N) in one row (s)
    double first_break_load = 1;     ///< factor of the event alone
    std::optional<double> peak = 1;  ///< the same; nothing: no such event
    double time_step = 1e-3, end = 0.3;
    int every = 10;

    void write(const fs::path& folder) const {
        RunWriter writer(folder);
        writer.topology(topology);
        writer.history_header({"tip"}, 2);
        const int steps = static_cast<int>(std::lround(end / time_step));
        std::vector<Break> breaks;
        for (int b = 0; b < static_cast<int>(topology.first.size()); ++b)
            if (std::isfinite(broken_at[b]))
                breaks.push_back({broken_at[b], b, topology.first[b], topology.second[b]});
        writer.breaks(breaks);
        RunSummary summary;
        for (int step = 0; step <= steps; step += every) {
            Snapshot s = example::snapshot(0);
            s.step = step;
            s.time = step * time_step;
            for (int i = 0; i < 3; ++i) s.displacement[i] = Vec3(0.1 * i * s.time, 0, 0);
            if (s.time >= shift_from)
                s.displacement[shifted].y() += shift + shift_rate * (s.time - shift_from);
            HistoryRow row;
            row.time = s.time;
            row.load = load * 1e6 * std::min(s.time, 0.2);
            if (std::abs(row.time - bump_at) < 1e-9) row.load += bump;
            row.loads = row.displacements = {0};
            writer.row(row);
            writer.state(s);
        }
        const double first = std::min(broken_at[0], broken_at[1]);
        if (std::isfinite(first))
            summary.events.first_break = Event{.time = first, .load = first_break_load * load * 1e6 * first};
        if (peak) summary.events.peak_load = Event{.time = 0.2, .load = *peak * load * 2e5};
        summary.time_step = time_step;
        summary.steps = steps;
        summary.end_time = end;
        writer.finish(summary);
    }
};

RunDifference compare(const Pulled& a, const Pulled& b, const RunTolerance& tolerance = {}) {
    const TemporaryFolder folder;
    a.write(folder.path() / "a");
    b.write(folder.path() / "b");
    return difference(RunReader(folder.path() / "a"), RunReader(folder.path() / "b"), tolerance);
}

TEST(RunDifference, OfEqualRunsIsNothing) {
    const RunDifference d = compare({}, {});
    EXPECT_TRUE(d.identical);
    EXPECT_TRUE(d.same);
    EXPECT_EQ(d.positions.compared, 31);
    EXPECT_EQ(d.bonds.expected_broken, 1);
}

TEST(RunDifference, NamesTheFirstBondThatBreaksAtAnotherStep) {
    Pulled later;
    later.broken_at[1] = 0.153;
    RunDifference d = compare({}, later);
    ASSERT_TRUE(d.bonds.first);
    EXPECT_EQ(d.bonds.first->steps, 3);
    EXPECT_EQ(describe(*d.bonds.first), "bond 1-2 broke 3 steps later");
    EXPECT_EQ(physics_verdict(d, {}),
              "physics changed first at t = 150.0 ms: bond 1-2 broke 3 steps later; load "
              "at first break +2.0 %");
    d = compare(later, {});
    EXPECT_EQ(describe(*d.bonds.first), "bond 1-2 broke 3 steps earlier");
    EXPECT_TRUE(compare({}, later, {.break_steps = 3, .load = 0.1}).same);
    EXPECT_FALSE(compare({}, later, {.break_steps = 2, .load = 0.1}).same);

    Pulled both;
    both.broken_at[0] = 0.12;
    d = compare({}, both);
    EXPECT_EQ(d.bonds.first->bond, 0);
    EXPECT_EQ(describe(*d.bonds.first), "bond 0-1 broke, which it did not");
    EXPECT_EQ(describe(*compare(both, {}).bonds.first), "bond 0-1 did not break");
}

TEST(RunDifference, TheFirstBondIsTheOneThatBreaksFirst) {
    Pulled a, b;
    a.broken_at = {0.2, 0.15};
    b.broken_at = {0.19, 0.12};
    const RunDifference d = compare(a, b);
    EXPECT_EQ(d.bonds.changed, 2);
    EXPECT_EQ(d.bonds.first->bond, 1);
    EXPECT_EQ(d.bonds.expected_broken, 2);
    Pulled next;
    next.broken_at[1] = 0.151;
    EXPECT_EQ(describe(*compare({}, next).bonds.first), "bond 1-2 broke 1 step later");
}

// Times are read from a file of decimals: less than half a step is the same step, though not the same run.
TEST(RunDifference, ABreakWithinTheSameStepIsTolerated) {
    Pulled a, b;
    a.broken_at = {0.2, 0.15};
    b.broken_at = {0.2004, 0.15};
    RunDifference d = compare(a, b);
    EXPECT_TRUE(d.same);
    EXPECT_FALSE(d.identical);
    EXPECT_EQ(d.bonds.changed, 0);
    EXPECT_EQ(d.bonds.other_step, 1);
    b.broken_at[0] = 0.2006;
    EXPECT_FALSE(compare(a, b).same);
}

TEST(RunDifference, FindsWhereAndWhenAParticleIsElsewhere) {
    Pulled moved;
    moved.shift = 0.02;
    const RunDifference d = compare({}, moved);
    ASSERT_TRUE(d.positions.first_beyond);
    EXPECT_EQ(d.positions.first_beyond->particle, 1);
    EXPECT_DOUBLE_EQ(d.positions.first_beyond->time, 0.1);
    EXPECT_NEAR(d.positions.first_beyond->distance, 0.02, 1e-15);
    EXPECT_EQ(physics_verdict(d, {}),
              "physics changed first at t = 100.0 ms: particle 1 is off by 20.0 mm (0.02 spacings)");
    EXPECT_TRUE(compare({}, moved, {.position = 0.021}).same);
    EXPECT_FALSE(compare({}, moved, {.position = 0.021}).identical);

    moved.shift = std::nan("");
    EXPECT_FALSE(compare({}, moved).same);
    EXPECT_TRUE(compare(moved, moved).identical);
}

TEST(RunDifference, MeasuresTheLargestOffsetInSpacingsOfItsParticle) {
    Pulled moved;
    moved.shifted = 2;  // with a seventh of the others' spacing
    moved.shift = 0.01;
    moved.shift_rate = 0.1;
    const RunDifference d = compare({}, moved);
    ASSERT_TRUE(d.positions.largest);
    EXPECT_EQ(d.positions.largest->particle, 2);
    EXPECT_DOUBLE_EQ(d.positions.largest->time, 0.3);
    EXPECT_NEAR(d.positions.largest->distance, 0.03, 1e-15);
    EXPECT_NEAR(d.positions.largest->spacings, 0.21, 1e-14);
    EXPECT_NEAR(d.positions.first_beyond->spacings, 0.07, 1e-14);
}

TEST(RunDifference, OfRunsThatRecordedOtherStepsComparesTheCommonOnes) {
    Pulled rarer;
    rarer.every = 20;
    const RunDifference d = compare({}, rarer);
    EXPECT_EQ(d.positions.compared, 16);
    EXPECT_TRUE(d.same);
    EXPECT_FALSE(d.positions.interpolated);
}

TEST(RunDifference, AShorterRunDiffersByItsEndAndOnlyByThat) {
    Pulled shorter;
    shorter.end = 0.15;
    RunDifference d = compare({}, shorter);
    EXPECT_FALSE(d.same);
    EXPECT_EQ(d.positions.compared, 16);
    EXPECT_EQ(d.curve->largest, 0);
    EXPECT_EQ(physics_verdict(d, {}),
              "physics changed first at t = 150.0 ms: it ends at 150.0 ms, not at 300.0 ms");
    // With another time step nothing is made up beyond the last state, at 210 steps of 0.7 ms.
    shorter.time_step = 0.7e-3;
    shorter.every = 7;
    d = compare({}, shorter);
    EXPECT_EQ(d.positions.compared, 15);
    EXPECT_FALSE(d.positions.largest && d.positions.largest->spacings > 1e-9);
}

TEST(RunDifference, SaysHowMuchTheLoadChanged) {
    Pulled stronger;
    stronger.load = 1.018;
    const RunDifference d = compare({}, stronger);
    ASSERT_TRUE(d.curve);
    EXPECT_NEAR(d.curve->largest, 0.018 * 2e5, 1);
    EXPECT_EQ(relative_change(d.curve->peak), "+1.8 %");
    // 1.8 % of 1 MN/s is a thousandth of the peak, 200 N, at 11.1 ms: the next of 1000 moments.
    EXPECT_NEAR(*d.curve->first_beyond, 0.0111, 0.0003);
    EXPECT_NE(physics_verdict(d, {}).find(
                  "the load is off, by 3.60 kN at most; load at first break +1.8 %; peak load +1.8 %"),
              std::string::npos)
        << physics_verdict(d, {});
    EXPECT_TRUE(compare({}, stronger, {.load = 0.02}).same);
}

TEST(RunDifference, TheWholeLoadCurveCounts) {
    Pulled bump;
    bump.bump = 10;
    RunDifference d = compare({}, bump);
    EXPECT_TRUE(d.same);
    EXPECT_FALSE(d.identical);
    EXPECT_NEAR(d.curve->largest, 10, 0.2);
    bump.bump = 1000;
    bump.bump_at = 0.25;
    d = compare({}, bump);
    EXPECT_FALSE(d.same);
    EXPECT_NEAR(d.curve->largest, 1000, 20);
    EXPECT_NEAR(d.curve->largest_time, 0.25, 3e-4);
    EXPECT_NEAR(*d.curve->first_beyond, 0.242, 3e-4);  // a fifth of the way up, 200 N
    EXPECT_TRUE(compare({.load = -1}, {.load = -1.0005}).same);
    EXPECT_FALSE(compare({.load = -1}, {.load = -1.002}).same);
}

TEST(RunDifference, LoadsOfTheEventsCountByThemselves) {
    const RunDifference peak = compare({}, {.peak = 1.05});
    EXPECT_FALSE(peak.same);
    EXPECT_EQ(physics_verdict(peak, {}), "physics changed: peak load +5.0 %");
    const RunDifference first = compare({}, {.first_break_load = 0.995});
    EXPECT_FALSE(first.same);
    EXPECT_EQ(physics_verdict(first, {}), "physics changed: load at first break -0.50 %");
    const RunDifference none = compare({}, {.peak = {}});
    EXPECT_FALSE(none.same);
    EXPECT_EQ(physics_verdict(none, {}), "physics changed: peak load none, expected one");
    EXPECT_EQ(relative_change({{}, 1}), "one, expected none");
    EXPECT_EQ(relative_change({{}, {}}), "none");
    EXPECT_EQ(relative_change({0, 5}), "5.00 N in place of 0 N");
}

TEST(RunDifference, OfAnotherBodyIsSaid) {
    Pulled other;
    other.topology.first = {0, 0};
    other.load = 1.018;
    EXPECT_EQ(compare({}, other).other_body, "other particles are bonded");
    EXPECT_EQ(physics_verdict(compare({}, other), {}),
              "another body: other particles are bonded; load at first break +1.8 %; peak load +1.8 %");
    Pulled fewer;
    fewer.topology.first = {0};
    fewer.topology.second = {1};
    fewer.topology.rest_length = {1};
    EXPECT_EQ(compare({}, fewer).other_body, "1 bonds, not 2");
    Pulled solid;
    solid.topology.dimension = 3;
    EXPECT_EQ(compare({}, solid).other_body, "3 dimensions, not 2");
    Pulled moved;
    moved.topology.reference_position[2].y() += 1e-3;
    const RunDifference d = compare({}, moved);
    EXPECT_FALSE(d.same);
    EXPECT_EQ(physics_verdict(d, {}), "another body: particle 2 stands elsewhere in the unloaded body");
}

TEST(RunDifference, RunsWithAnotherTimeStepAreComparedBetweenStates) {
    Pulled finer;
    finer.time_step = 0.7e-3;
    finer.every = 7;
    RunDifference d = compare({}, finer, {.load = 0.01});
    EXPECT_TRUE(d.positions.interpolated);
    EXPECT_GT(d.positions.compared, 25);
    EXPECT_FALSE(d.identical);
    // The motion is even, so nothing is lost between states.
    EXPECT_LT(d.positions.largest ? d.positions.largest->spacings : 0, 1e-9);
    EXPECT_TRUE(d.same) << physics_verdict(d, {.load = 0.01});
    finer.shift = 0.1;
    d = compare({}, finer, {.load = 0.01});
    ASSERT_TRUE(d.positions.first_beyond);
    EXPECT_NEAR(d.positions.first_beyond->time, 0.1, 0.01);
}

}  // namespace
}  // namespace hibi
