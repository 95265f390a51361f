#include "measure/snapshots.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/bar.hpp"

namespace hibi {
namespace {

using test::bar;

TEST(UnbrokenBody, GivesTheSnapshotsOfMomentsBeforeTheFirstBreakBitForBit) {
    SimulationIn<2> simulation = bar(0.02, 0.5);
    for (int k = 0; k < 50; ++k) simulation.step();
    const Snapshot expected = take_snapshot(simulation);
    const Motion motion = copy_motion(simulation);
    while (simulation.broken() < 3 && simulation.time() < 5) simulation.step();
    ASSERT_GE(simulation.broken(), 3);
    const Snapshot late = UnbrokenBody(simulation).snapshot(motion);
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

TEST(Snapshot, DerivedFieldsAreThoseOfTheBondsAndTheLaw) {
    SimulationIn<2> simulation = bar(0.02, -0.5);  // squeezed: some bonds shorten, others lengthen
    while (simulation.broken() == 0) simulation.step();
    const Snapshot s = take_snapshot(simulation);
    const Model<2>& model = simulation.model();
    const State<2>& state = simulation.state();
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
            broken += !state.is_intact(b);
            if (!state.is_intact(b)) continue;
            const double length =
                (position(model, state, model.bonds.second[b]) - position(model, state, model.bonds.first[b]))
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
