#include "measure/run_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "support/plates.hpp"

namespace hibi {
namespace {

using test::plate;
using test::where;

TEST(Connection, AgreesWithUnionFindAfterEveryBreak) {
    std::mt19937 random(11);
    for (int trial = 0; trial < 20; ++trial) {
        Model<2> model = plate(12, 6, 1);
        const auto from = where(model, [](const Vec<2>& X) { return X.x() < 1; });
        const auto to = where(model, [](const Vec<2>& X) { return X.x() > 11; });
        Connection connection(from, to, model.bonds);
        ASSERT_TRUE(connection.existed());
        std::vector<int> order(model.bonds.count());
        std::iota(order.begin(), order.end(), 0);
        std::shuffle(order.begin(), order.end(), random);
        bool ever_apart = false;
        for (const int b : order) {
            model.bonds.broken_at[b] = 1;
            std::vector<int> root(model.particles.count());
            std::iota(root.begin(), root.end(), 0);
            const auto find = [&](int i) {
                while (root[i] != i) i = root[i] = root[root[i]];
                return i;
            };
            for (int k = 0; k < model.bonds.count(); ++k)
                if (model.bonds.is_intact(k)) root[find(model.bonds.first[k])] = find(model.bonds.second[k]);
            bool together = false;
            for (const int i : from)
                for (const int j : to) together |= find(i) == find(j);
            ASSERT_EQ(connection.holds(model.bonds, std::vector<int>{b}), together);
            ever_apart |= !together;
            if (ever_apart) break;
        }
        EXPECT_TRUE(ever_apart);
    }
}

/// A bar held on the left and pulled apart by moving its right end.
Simulation<2> bar(double break_strain, double velocity, double ramp = 0.2) {
    Material m = test::concrete();
    m.break_strain = break_strain;
    Model<2> model = plate(12, 3, 1, m);
    Physics physics;
    physics.holds = {{"clamp", where(model, [](const Vec<2>& X) { return X.x() < 1; }), {true, true, false}}};
    Load grip;
    grip.name = "grip";
    grip.kind = Load::Kind::velocity;
    grip.particles = where(model, [](const Vec<2>& X) { return X.x() > 11; });
    grip.driven = {true, false, false};
    grip.value = {Field(velocity), Field(0), Field(0)};
    grip.ramp = {ramp};
    physics.loads = {grip};
    physics.damping = Damping{.ratio = 0.1};
    return {model, physics};
}

TEST(Watch, SeesTheEventsOfABarPulledApartInTheirOrder) {
    Simulation<2> simulation = bar(0.02, 0.5);
    Watch<2> watch(simulation);
    int breaks = 0;
    double first = 0;
    while (!watch.peak_confirmed() && simulation.time() < 5) {
        simulation.step();
        watch.look();
        if (!watch.just_broken().empty() && breaks == 0) first = simulation.time();
        breaks += static_cast<int>(watch.just_broken().size());
    }
    for (int k = 0; k < 200; ++k) {
        simulation.step();
        watch.look();
        breaks += static_cast<int>(watch.just_broken().size());
    }
    const Events& e = watch.events();
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

TEST(UnbrokenBody, GivesTheSnapshotsOfMomentsBeforeTheFirstBreakBitForBit) {
    Simulation<2> simulation = bar(0.02, 0.5);
    for (int k = 0; k < 50; ++k) simulation.step();
    const Snapshot expected = take_snapshot(simulation);
    Motion<2> motion = copy_motion(simulation);
    while (simulation.broken() < 3 && simulation.time() < 5) simulation.step();
    ASSERT_GE(simulation.broken(), 3);
    const Snapshot late = UnbrokenBody<2>(simulation).snapshot(std::move(motion));
    EXPECT_EQ(late.time, expected.time);
    EXPECT_EQ(late.step, expected.step);
    EXPECT_TRUE(late.broken.empty());
    EXPECT_EQ(late.displacement, expected.displacement);
    EXPECT_EQ(late.velocity, expected.velocity);
    EXPECT_EQ(late.bond_strain, expected.bond_strain);
    EXPECT_EQ(late.damage, expected.damage);
    EXPECT_EQ(late.energy, expected.energy);
    EXPECT_EQ(late.stress, expected.stress);
    EXPECT_NE(take_snapshot(simulation).stress, expected.stress);
}

TEST(Watch, CountsTheFragmentsThatAFullSearchFinds) {
    Material m = test::concrete();
    m.break_strain = 0.01;
    Model<2> model = plate(60, 40, 1, m);
    // Blown apart from its middle.
    for (int i = 0; i < model.particles.count(); ++i)
        model.particles.velocity[i] = 0.15 * (model.particles.reference_position[i] - Vec<2>(30, 20));
    model.particles.velocity[700] = {40, 0};
    Simulation<2> simulation(model, {});
    Watch<2> watch(simulation);
    int most = 0;
    for (int k = 0; k < 400; ++k) {
        simulation.step();
        watch.look();
        if (simulation.just_broken().empty()) continue;
        const Fragments full = find_fragments(simulation.model()), fast = watch.fragments();
        ASSERT_EQ(fast.count, full.count);
        ASSERT_EQ(fast.largest, full.largest);
        ASSERT_EQ(fast.debris, full.debris);
        most = std::max(most, full.count);
    }
    EXPECT_GT(simulation.broken(), 100);
    EXPECT_GT(watch.fragments().debris, 0);
    EXPECT_GT(most, 1);
}

TEST(Watch, WhatWasNeverConnectedCannotSeparate) {
    const std::vector<Notch<2>> through = {{.name = "through", .points = {{6, -1}, {6, 4}}}};
    Material m = test::concrete();
    m.break_strain = 0.02;
    Model<2> model = plate(12, 3, 1, m, Assumption::plane_stress, through);
    Physics physics;
    physics.holds = {{"clamp", where(model, [](const Vec<2>& X) { return X.x() < 1; }), {true, true, false}}};
    physics.loads = {
        test::pull(model, where(model, [](const Vec<2>& X) { return X.x() > 11; }), {1e3, 0}, 0)};
    Simulation<2> simulation(model, physics);
    Watch<2> watch(simulation);
    EXPECT_FALSE(watch.can_separate());
    for (int k = 0; k < 10; ++k) {
        simulation.step();
        watch.look();
    }
    EXPECT_FALSE(watch.events().separation);
}

TEST(Watch, WhatIsLoadedDoesNotCountAsHeld) {
    // Shear: the top row stands on rollers and is pushed sideways; only the bottom holds the plate.
    Material m = test::concrete();
    m.break_strain = 0.02;
    Model<2> model = plate(8, 8, 1, m);
    const auto top = where(model, [](const Vec<2>& X) { return X.y() > 7; });
    Physics physics;
    physics.holds = {{"bottom", where(model, [](const Vec<2>& X) { return X.y() < 1; }), {true, true, false}},
                     {"rollers", top, {false, true, false}}};
    physics.loads = {test::pull(model, top, {1e8, 0}, 1)};
    Simulation<2> simulation(model, physics);
    Watch<2> watch(simulation);
    ASSERT_TRUE(watch.can_separate());
    while (!watch.events().separation && simulation.time() < 5) {
        simulation.step();
        watch.look();
    }
    EXPECT_TRUE(watch.events().separation);
}

TEST(Watch, AnElasticWaveIsNoPeak) {
    // Pulled at once: the reaction swings long before anything breaks.
    Simulation<2> simulation = bar(0.2, 4, 0);
    Watch<2> watch(simulation);
    double largest = 0;
    bool fell = false;
    while (!watch.events().first_break && simulation.time() < 5) {
        simulation.step();
        watch.look();
        const double load = simulation.read(0).load;
        largest = std::max(largest, load);
        fell |= load <= 0.8 * largest;
        if (!watch.events().first_break) {
            ASSERT_FALSE(watch.peak_confirmed()) << simulation.time();
        }
    }
    EXPECT_TRUE(fell);
    EXPECT_TRUE(watch.events().first_break);
}

TEST(Watch, AnEventThatDidNotHappenHasNoTime) {
    Simulation<2> simulation = bar(10, 0.1);
    Watch<2> watch(simulation);
    simulation.step();
    watch.look();
    EXPECT_FALSE(watch.events().first_break);
    EXPECT_FALSE(watch.events().time_of({EventName::separation, 1}));
    EXPECT_EQ(watch.events().time_of({{}, 1.5}), 1.5);
    EXPECT_EQ(watch.events().time_of({EventName::start, 0.5}), 0.5);
}

TEST(Watch, RowHoldsTheEnergiesAndEveryLoad) {
    Simulation<2> simulation = bar(10, 0.1);
    Watch<2> watch(simulation);
    for (int k = 0; k < 300; ++k) {
        simulation.step();
        watch.look();
    }
    const HistoryRow row = watch.row();
    EXPECT_EQ(row.loads.size(), 1u);
    EXPECT_EQ(row.load, row.loads[0]);
    EXPECT_EQ(row.load, simulation.read(0).load);
    EXPECT_GT(row.elastic, 0);
    EXPECT_LE(row.imbalance, 1e-3);
    EXPECT_EQ(row.broken, 0);
}

TEST(Snapshot, DerivedFieldsAreThoseOfTheBondsAndTheLaw) {
    Simulation<2> simulation = bar(0.02, -0.5);  // squeezed: some bonds shorten, others lengthen
    while (simulation.broken() == 0) simulation.step();
    const Snapshot s = take_snapshot(simulation);
    const Model<2>& model = simulation.model();
    ASSERT_EQ(s.count(), model.particles.count());
    ASSERT_EQ(static_cast<int>(s.broken.size()), simulation.broken());
    double energy = 0;
    for (const float e : s.energy) energy += e;
    EXPECT_NEAR(energy / simulation.energies().elastic, 1, 1e-5);
    for (int i = 0; i < s.count(); ++i) {
        int broken = 0;
        double largest = 0;
        for (int b = 0; b < model.bonds.count(); ++b) {
            if (model.bonds.first[b] != i && model.bonds.second[b] != i) continue;
            broken += !model.bonds.is_intact(b);
            if (!model.bonds.is_intact(b)) continue;
            const double length = (model.particles.position(model.bonds.second[b]) -
                                   model.particles.position(model.bonds.first[b]))
                                      .norm();
            const double strain = length / model.bonds.rest_length[b] - 1;
            if (std::abs(strain) > std::abs(largest)) largest = strain;
        }
        EXPECT_NEAR(s.bond_strain[i], largest, 1e-7);
        EXPECT_FLOAT_EQ(s.damage[i], static_cast<float>(broken) /
                                         static_cast<float>(model.bonds.start[i + 1] - model.bonds.start[i]));
    }
}

}  // namespace
}  // namespace hibi
