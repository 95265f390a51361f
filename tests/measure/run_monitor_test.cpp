#include "measure/run_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "measure/cracks.hpp"
#include "support/bar.hpp"

namespace hibi {
namespace {

using test::bar;
using test::plate;
using test::where;

TEST(RunMonitor, SeesTheEventsOfABarPulledApartInTheirOrder) {
    SimulationIn<2> simulation = bar(0.02, 0.5);
    const auto monitor = make_run_monitor(simulation);
    int breaks = 0;
    double first = 0;
    while (!monitor->peak_confirmed() && simulation.time() < 5) {
        simulation.step();
        monitor->look();
        if (!monitor->just_broken().empty() && breaks == 0) first = simulation.time();
        breaks += static_cast<int>(monitor->just_broken().size());
    }
    for (int k = 0; k < 200; ++k) {
        simulation.step();
        monitor->look();
        breaks += static_cast<int>(monitor->just_broken().size());
    }
    const Events& e = monitor->events();
    ASSERT_TRUE(e.first_break && e.peak_load && e.separation);
    EXPECT_EQ(breaks, simulation.broken());
    EXPECT_EQ(e.first_break->time, first);
    EXPECT_LE(e.peak_load->time, e.separation->time);
    EXPECT_GT(e.peak_load->load,
              0.5 * 2.1e8 * 3 * 0.02);  // E A strain, within the stress raised at the grips
    EXPECT_LT(e.peak_load->load, 1.3 * 2.1e8 * 3 * 0.02);
    EXPECT_LE(e.first_break->time, e.separation->time);
    // a displacement of the grip that separates the bar is at least what its bonds can stretch
    EXPECT_GT(e.separation->displacement, 0.02 * 11 * 0.5);
    EXPECT_EQ(e.time_of({EventName::separation, 0.25}), e.separation->time + 0.25);
}

TEST(RunMonitor, CountsTheFragmentsThatAFullSearchFinds) {
    Material m = test::concrete();
    m.break_strain = 0.01;
    Model<2> model = plate(60, 40, 1, m);
    // Blown apart from its middle.
    for (int i = 0; i < model.particles.count(); ++i)
        model.particles.initial_velocity[i] = 0.15 * (model.particles.reference_position[i] - Vec<2>(30, 20));
    model.particles.initial_velocity[700] = {40, 0};
    SimulationIn<2> simulation(model, {});
    const auto monitor = make_run_monitor(simulation);
    int most = 0;
    for (int k = 0; k < 400; ++k) {
        simulation.step();
        monitor->look();
        if (simulation.just_broken().empty()) continue;
        const Fragments full = find_fragments(simulation.model(), simulation.state()), fast = monitor->fragments();
        ASSERT_EQ(fast.count, full.count);
        ASSERT_EQ(fast.largest, full.largest);
        ASSERT_EQ(fast.debris, full.debris);
        most = std::max(most, full.count);
    }
    EXPECT_GT(simulation.broken(), 100);
    EXPECT_GT(monitor->fragments().debris, 0);
    EXPECT_GT(most, 1);
}

TEST(RunMonitor, WhatWasNeverConnectedCannotSeparate) {
    const std::vector<Notch<2>> through = {{.name = "through", .points = {{6, -1}, {6, 4}}}};
    Material m = test::concrete();
    m.break_strain = 0.02;
    Model<2> model = plate(12, 3, 1, m, Assumption::plane_stress, through);
    Physics physics;
    physics.holds = {{"clamp", where(model, [](const Vec<2>& X) { return X.x() < 1; }), {true, true, false}}};
    physics.loads = {
        test::pull(model, where(model, [](const Vec<2>& X) { return X.x() > 11; }), {1e3, 0}, 0)};
    SimulationIn<2> simulation(model, physics);
    const auto monitor = make_run_monitor(simulation);
    EXPECT_FALSE(monitor->can_separate());
    for (int k = 0; k < 10; ++k) {
        simulation.step();
        monitor->look();
    }
    EXPECT_FALSE(monitor->events().separation);
}

TEST(RunMonitor, WhatIsLoadedDoesNotCountAsHeld) {
    // Shear: the top row stands on rollers and is pushed sideways; only the bottom holds the plate.
    Material m = test::concrete();
    m.break_strain = 0.02;
    Model<2> model = plate(8, 8, 1, m);
    const auto top = where(model, [](const Vec<2>& X) { return X.y() > 7; });
    Physics physics;
    physics.holds = {{"bottom", where(model, [](const Vec<2>& X) { return X.y() < 1; }), {true, true, false}},
                     {"rollers", top, {false, true, false}}};
    physics.loads = {test::pull(model, top, {1e8, 0}, 1)};
    SimulationIn<2> simulation(model, physics);
    const auto monitor = make_run_monitor(simulation);
    ASSERT_TRUE(monitor->can_separate());
    while (!monitor->events().separation && simulation.time() < 5) {
        simulation.step();
        monitor->look();
    }
    EXPECT_TRUE(monitor->events().separation);
}

TEST(RunMonitor, AnElasticWaveIsNoPeak) {
    // Pulled at once: the reaction swings long before anything breaks.
    SimulationIn<2> simulation = bar(0.2, 4, 0);
    const auto monitor = make_run_monitor(simulation);
    double largest = 0;
    bool fell = false;
    while (!monitor->events().first_break && simulation.time() < 5) {
        simulation.step();
        monitor->look();
        const double load = simulation.read(0).load;
        largest = std::max(largest, load);
        fell |= load <= 0.8 * largest;
        if (!monitor->events().first_break) {
            ASSERT_FALSE(monitor->peak_confirmed()) << simulation.time();
        }
    }
    EXPECT_TRUE(fell);
    EXPECT_TRUE(monitor->events().first_break);
}

TEST(RunMonitor, AnEventThatDidNotHappenHasNoTime) {
    SimulationIn<2> simulation = bar(10, 0.1);
    const auto monitor = make_run_monitor(simulation);
    simulation.step();
    monitor->look();
    EXPECT_FALSE(monitor->events().first_break);
    EXPECT_FALSE(monitor->events().time_of({EventName::separation, 1}));
    EXPECT_EQ(monitor->events().time_of({{}, 1.5}), 1.5);
    EXPECT_EQ(monitor->events().time_of({EventName::start, 0.5}), 0.5);
}

TEST(RunMonitor, RowHoldsTheEnergiesAndEveryLoad) {
    SimulationIn<2> simulation = bar(10, 0.1);
    const auto monitor = make_run_monitor(simulation);
    for (int k = 0; k < 300; ++k) {
        simulation.step();
        monitor->look();
    }
    const HistoryRow row = monitor->row();
    EXPECT_EQ(row.loads.size(), 1u);
    EXPECT_EQ(row.load, row.loads[0]);
    EXPECT_EQ(row.load, simulation.read(0).load);
    EXPECT_GT(row.elastic, 0);
    EXPECT_LE(row.imbalance, 1e-3);
    EXPECT_EQ(row.broken, 0);
}

}  // namespace
}  // namespace hibi
