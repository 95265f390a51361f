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
    double shift = 0, shift_from = 0.1;  ///< of the second particle (m), from so late (s)
    double load = 1;                     ///< factor
    double time_step = 1e-3;
    int every = 10;

    void write(const fs::path& folder) const {
        RunWriter writer(folder);
        writer.topology(topology);
        writer.history_header({"tip"}, 2);
        const int steps = static_cast<int>(std::lround(0.3 / time_step));
        std::vector<Break> breaks;
        for (int b = 0; b < 2; ++b)
            if (std::isfinite(broken_at[b]))
                breaks.push_back({broken_at[b], b, topology.first[b], topology.second[b]});
        writer.breaks(breaks);
        RunSummary summary;
        for (int step = 0; step <= steps; step += every) {
            Snapshot s = example::snapshot(0);
            s.step = step;
            s.time = step * time_step;
            for (int i = 0; i < 3; ++i) s.displacement[i] = Vec3(0.1 * i * s.time, 0, 0);
            if (s.time >= shift_from) s.displacement[1].y() += shift;
            HistoryRow row;
            row.time = s.time;
            row.load = load * 1e6 * std::min(s.time, 0.2);
            row.loads = row.displacements = {0};
            writer.row(row);
            writer.state(s);
        }
        const double first = std::min(broken_at[0], broken_at[1]);
        if (std::isfinite(first))
            summary.events.first_break = Event{.time = first, .load = load * 1e6 * first};
        summary.events.peak_load = Event{.time = 0.2, .load = load * 2e5};
        summary.time_step = time_step;
        summary.steps = steps;
        summary.end_time = 0.3;
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

TEST(RunDifference, OfAnotherBodyIsSaid) {
    Pulled fewer;
    fewer.topology.first = {0, 0};
    EXPECT_EQ(compare({}, fewer).other_body, "other particles are bonded");
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
    finer.shift = 0.1;
    d = compare({}, finer, {.load = 0.01});
    ASSERT_TRUE(d.positions.first_beyond);
    EXPECT_NEAR(d.positions.first_beyond->time, 0.1, 0.01);
}

}  // namespace
}  // namespace hibi
