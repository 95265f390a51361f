#include "solve/recorder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/plates.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

TEST(EvenStates, AreEvenAndBoundedHoweverLongTheRun) {
    for (const int steps : {50, 1000, 12345, 100000}) {
        EvenStates states(0, 4.0, 20);
        std::set<std::int64_t> kept;
        for (int step = 0; step <= steps; ++step) {
            if (!states.due(step)) continue;
            kept.insert(step);
            for (const std::int64_t dropped : states.keep(step, step)) EXPECT_EQ(kept.erase(dropped), 1u);
            EXPECT_LE(kept.size(), 20u);
        }
        EXPECT_GE(kept.size(), std::min<std::size_t>(10, steps / 4));
        EXPECT_EQ(*kept.begin(), 0);
        EXPECT_GT(*kept.rbegin(), steps - 2 * states.interval());
        std::int64_t last = -1;
        for (const std::int64_t step : kept) {
            if (last >= 0) {
                EXPECT_EQ(step - last, static_cast<std::int64_t>(states.interval())) << steps;
            }
            last = step;
        }
    }
}

TEST(EvenStates, GoOnWhereTheIntervalIsLostInTheDigitsOfTheTime) {
    EvenStates states(1, 1e-19, 20);
    ASSERT_TRUE(states.due(1));
    states.keep(1, 1);  // came to no end when it added intervals up
    EXPECT_FALSE(states.due(1));
    EXPECT_TRUE(states.due(1.001));
}

/// A bar torn apart by its own motion, recorded until `max_time`.
struct Recorded {
    double stable_time_step = 0, time_step = 0;
    double first_break = 0;
    std::int64_t written = 0;      ///< states, those dropped later included
    std::vector<double> before{};  ///< times of the states up to first break (s)
    std::vector<double> after{};   ///< and from there on
};
Recorded record(int columns, int rows, const Scene& scene, double break_strain) {
    Material material = test::concrete();
    material.break_strain = break_strain;
    Model<2> model = test::plate(columns, rows, 1, material);
    for (int i = 0; i < model.particles.count(); ++i)
        model.particles.initial_velocity[i].x() = 0.5 * (model.particles.reference_position[i].x() - columns / 2.0);
    SimulationIn<2> simulation(std::move(model), {});
    const auto monitor = make_run_monitor(simulation);
    const TemporaryFolder folder;
    StageTimes times({});
    RunWriter writer(folder.path(), {}, &times);
    Topology topology;
    for (const Vec<2>& X : simulation.model().particles.reference_position)
        topology.reference_position.push_back(to_3d<2>(X));
    topology.spacing.assign(topology.reference_position.size(), 1);
    topology.body.assign(topology.reference_position.size(), 0);
    topology.body_names = {"bar"};
    topology.first = simulation.model().bonds.first;
    topology.second = simulation.model().bonds.second;
    topology.rest_length = simulation.model().bonds.rest_length;
    writer.topology(topology);
    Recorder recorder(scene, simulation, *monitor, writer);
    while (simulation.time() < scene.run.max_time) {
        simulation.step();
        monitor->look();
        recorder.look();
    }
    recorder.finish();
    writer.finish({});
    Recorded recorded{.stable_time_step = simulation.stable_time_step(), .time_step = simulation.time_step()};
    for (const StageTime& stage : times.list())
        if (stage.name == "write states") recorded.written = stage.calls;
    const double first_break = monitor->events().first_break ? monitor->events().first_break->time : 1e9;
    recorded.first_break = first_break;
    const RunReader run(folder.path());
    for (const StateInfo& state : run.states())
        (state.time <= first_break ? recorded.before : recorded.after).push_back(state.time);
    return recorded;
}

double shortest_interval(const std::vector<double>& times) {
    double shortest = 1e9;
    for (std::size_t k = 1; k < times.size(); ++k) shortest = std::min(shortest, times[k] - times[k - 1]);
    return shortest;
}

Scene film_of(double max_time) {
    Scene scene;
    scene.run.max_time = max_time;
    scene.movie.duration = 4;
    scene.movie.fps = 25;
    return scene;
}

TEST(Recorder, WritesNoStateInVainWhereTheEndIsKnown) {
    const double step = record(20, 3, film_of(0), 10).time_step;
    const Recorded known = record(20, 3, film_of(3000 * step), 10);
    EXPECT_EQ(known.written, static_cast<std::int64_t>(known.before.size()));
    EXPECT_GE(known.written, 99);  // for 100 frames
    EXPECT_LE(known.written, 102);
}

TEST(Recorder, LooksMoreSeldomAtALargeBodyWhereWavesNeedLonger) {
    Scene scene = film_of(0);
    const double step = record(200, 200, scene, 0.01).time_step;
    scene.run.max_time = 400 * step;
    const Recorded large = record(200, 200, scene, 0.01);
    ASSERT_NEAR(large.stable_time_step, 2 * step, 0.01 * step);
    // Every 8 steps at the densest, for the body and for its failure in one, and what the ring held.
    EXPECT_LE(large.written, 400 / 8 + 12);
    EXPECT_GE(large.after.size(), 10u);
    const Recorded slender = record(200, 3, scene, 0.01);
    EXPECT_LT(shortest_interval(slender.after), 2.5 * step);
    scene.movie.slow = {{.around = {EventName::first_break, 0}, .span = 200 * step, .rate = 0.1}};
    EXPECT_LT(shortest_interval(record(200, 200, scene, 0.01).after), 2.5 * step);
}

TEST(Recorder, KeepsTheStatesOfFirstBreakAndJustBefore) {
    Scene scene = film_of(0);
    const double step = record(100, 100, scene, 0.03).time_step;
    scene.run.max_time = 400 * step;
    const double first_break = record(100, 100, scene, 0.03).first_break;
    ASSERT_LT(first_break, scene.run.max_time);
    // Even ones every 20 to 60 steps, and one of them a step before first break: it must not stand for that.
    const double even = (first_break - 1.3 * step) / std::max(1.0, std::floor(first_break / (40 * step)));
    scene.run.max_time = 99 * even;
    const Recorded recorded = record(100, 100, scene, 0.03);
    ASSERT_GE(recorded.before.size(), 5u);
    EXPECT_EQ(recorded.before.back(), first_break);
    EXPECT_NEAR(recorded.before[recorded.before.size() - 2], first_break - step, 0.01 * step);
    EXPECT_GT(recorded.before[recorded.before.size() - 5], first_break - 40 * step);  // of the ring
}

}  // namespace
}  // namespace hibi
