// Whole runs on the fast loops of elasticity/bond_kernel.hpp.
#include <gtest/gtest.h>

#include <cstdlib>

#include "elasticity/bond_kernel.hpp"
#include "simulation/simulation.hpp"
#include "support/plain_bonds.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

TEST(Simulation, HoldsParticlesWhereverTheyStandInABlock) {
    Model<2> model = test::plate(60, 30, 1);  // two blocks
    const std::vector<int> held = test::where(model, [](const Vec<2>& X) { return X.x() > 58; });
    for (Vec<2>& v : model.particles.initial_velocity) v = {1, 0.5};
    Physics physics;
    physics.holds = {{"right", held, {true, true, false}}};
    SimulationIn<2> simulation(model, physics);
    for (int k = 0; k < 50; ++k) simulation.step();
    for (const int i : held) EXPECT_TRUE(simulation.state().displacement[i].isZero(0));
    EXPECT_GT(simulation.state().displacement[0].x(), 0);
}

TEST(Loops, RenewedAfterBreaksAreThoseOfTheWholeBody) {
    Material m = test::concrete();
    m.break_strain = 0.02;
    Model<2> model = test::plate(100, 60, 1, m);  // six blocks
    const ElasticCoefficients coefficients = elastic_coefficients(model);
    for (int i = 0; i < model.particles.count(); ++i)
        model.particles.initial_velocity[i].y() = model.particles.reference_position[i].x() < 30 ? 20 : 0;
    SimulationIn<2> simulation(model, {});
    int breaking_steps = 0;
    for (int k = 0; k < 200 && breaking_steps < 20; ++k) {
        simulation.step();
        if (simulation.just_broken().empty()) continue;
        ++breaking_steps;
        EXPECT_TRUE(simulation.state().force ==
                    test::plain_forces(simulation.model(), simulation.state(), coefficients));
    }
    EXPECT_EQ(breaking_steps, 20);
}

/// Which loops() are taken, while it lives.
class Level {
 public:
    explicit Level(const char* level) { setenv("HIBI_CPU_LEVEL", level, 1); }
    ~Level() { unsetenv("HIBI_CPU_LEVEL"); }
};

TEST(Loops, OfEveryLevelGiveOneRunBitForBit) {
    const auto positions = [](const char* name) {
        const Level level(name);
        Material m = test::concrete();
        m.break_strain = 0.02;
        m.weibull = Weibull{.shape = 10, .seed = 1};
        Model<2> model = test::plate(40, 30, 1, m);
        for (int i = 0; i < model.particles.count(); ++i)
            model.particles.initial_velocity[i].x() = model.particles.reference_position[i].x() - 20;
        SimulationIn<2> simulation(model, {});
        for (int k = 0; k < 300; ++k) simulation.step();
        EXPECT_GT(simulation.broken(), 10);
        return simulation.state().velocity;
    };
    const auto v2 = positions("v2");
    EXPECT_TRUE(v2 == positions("v3"));
    EXPECT_TRUE(v2 == positions("v4"));
}

}  // namespace
}  // namespace hibi
