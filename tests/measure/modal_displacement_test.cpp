#include "measure/modal_displacement.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/plates.hpp"

namespace hibi {
namespace {

TEST(Swing, ReadsTheMotionAlongTheStart) {
    Model<2> model = test::plate(4, 4, 1);
    EXPECT_FALSE(Swing<2>(model).exists());
    for (int i = 0; i < model.particles.count(); ++i) model.particles.velocity[i] = {0.1 * i, 2};
    const Swing<2> swing(model);
    ASSERT_TRUE(swing.exists());
    for (int i = 0; i < model.particles.count(); ++i)
        model.particles.displacement[i] = 0.25 * model.particles.velocity[i];
    EXPECT_NEAR(swing(model), 0.25, 1e-15);
    for (int i = 0; i < model.particles.count(); ++i) model.particles.displacement[i] = {-2, 0.1 * i};
    EXPECT_NEAR(swing(model), 0, 1e-15) << "across the start";
}

TEST(Swing, PeriodIsThatOfASine) {
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

TEST(Swing, AngularMomentumOfATurningPlate) {
    Model<2> model = test::plate(4, 4, 1);
    double inertia = 0;
    for (int i = 0; i < model.particles.count(); ++i) {
        const Vec<2>& X = model.particles.reference_position[i];
        model.particles.velocity[i] = 0.5 * Vec<2>(-X.y(), X.x());
        inertia += model.particles.mass[i] * X.squaredNorm();
    }
    EXPECT_NEAR(angular_momentum(model), 0.5 * inertia, 1e-9 * inertia);
    model.spin = make_spin(model);
    model.spin->velocity.assign(model.particles.count(), 0.5);
    EXPECT_NEAR(angular_momentum(model), 0.5 * (inertia + 16 * model.spin->inertia[0]), 1e-9 * inertia);
}

}  // namespace
}  // namespace hibi
