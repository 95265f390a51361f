#include "measure/modal_displacement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "elasticity/thesis.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

TEST(ModalDisplacement, ReadsTheMotionAlongTheStart) {
    Model<2> model = test::plate(4, 4, 1);
    EXPECT_FALSE(ModalDisplacement(SimulationIn<2>(model, {})).exists());
    for (int i = 0; i < model.particles.count(); ++i) model.particles.initial_velocity[i] = {0.1 * i, 2};
    SimulationIn<2> simulation(model, {});
    const ModalDisplacement swing(simulation);
    ASSERT_TRUE(swing.exists());
    State<2> state = simulation.state();
    for (int i = 0; i < model.particles.count(); ++i) state.displacement[i] = 0.25 * state.velocity[i];
    simulation.go_on_from(state);
    EXPECT_NEAR(swing(simulation), 0.25, 1e-15);
    for (int i = 0; i < model.particles.count(); ++i) state.displacement[i] = {-2, 0.1 * i};
    simulation.go_on_from(state);
    EXPECT_NEAR(swing(simulation), 0, 1e-15) << "across the start";
}

TEST(ModalDisplacement, PeriodIsThatOfASine) {
    std::vector<double> times, swing;
    for (int k = 0; k < 700; ++k) {
        times.push_back(0.01 * k);
        swing.push_back(3 * std::sin(2 * M_PI * times.back() / 1.9));
    }
    // The chord of a sine leaves its zero by (2 pi h / T)^3 / (9 sqrt 3) of a step at most.
    EXPECT_NEAR(period_of(times, swing).value(), 1.9, 1e-6);
    EXPECT_FALSE(period_of(std::span(times).first(90), std::span(swing).first(90)))
        << "less than half a period";
}

TEST(ModalDisplacement, AngularMomentumOfATurningPlate) {
    Model<2> model = test::plate(4, 4, 1);
    double inertia = 0;
    for (int i = 0; i < model.particles.count(); ++i) {
        const Vec<2>& X = model.particles.reference_position[i];
        model.particles.initial_velocity[i] = 0.5 * Vec<2>(-X.y(), X.x());
        inertia += model.particles.mass[i] * X.squaredNorm();
    }
    EXPECT_NEAR(angular_momentum(SimulationIn<2>(model, {})), 0.5 * inertia, 1e-9 * inertia);
    const SimulationIn<2> thesis(model, {.elasticity = Elasticity::thesis});
    const double spin = 16 * spin_inertia(model.particles, 0);
    ASSERT_GT(spin, 1e-3 * inertia);
    EXPECT_NEAR(angular_momentum(thesis), 0.5 * (inertia + spin), 1e-9 * inertia);
}

}  // namespace
}  // namespace hibi
