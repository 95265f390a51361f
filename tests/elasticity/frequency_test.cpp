#include "elasticity/frequency.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "elasticity/tangent.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

using test::plate;

TEST(Frequency, EstimateHoldsForAStiffInclusionOfAThousandTimes) {
    Model<2> model;
    Material soft = test::concrete(), stiff = soft;
    stiff.youngs_modulus *= 1000;
    model.materials = {soft, stiff};
    add_body<2>(model, {.name = "soft", .shape = {Box<2>{{0, 0}, {8, 4}}}, .spacing = 1, .material = 0});
    add_body<2>(
        model,
        {.name = "stiff", .shape = {Box<2>{{8, 0}, {12, 4}}}, .spacing = 1, .material = 1, .bonded_to = {0}});
    connect<2>(model, {});
    const auto law = make_elastic_law<2>(model, Elasticity::moment_matched);
    const double estimate = highest_frequency(model, *law);
    Eigen::MatrixXd K = tangent(model, initial_state(model));
    K /= model.particles.mass[0];
    const double exact =
        std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues().maxCoeff());
    EXPECT_LE(estimate, exact * (1 + 1e-6));
    EXPECT_GE(estimate, exact * 0.99);
    EXPECT_GE(frequency_bound(model, initial_state(model)), exact);
}

TEST(Frequency, TooLargeAStepReallyIsUnstable) {
    // The refusal is right: the same integration with a step 1 % above the limit, done by hand.
    const Model<2> model = plate(8, 5, 1);
    const auto law = make_elastic_law<2>(model, Elasticity::moment_matched);
    const double omega = highest_frequency(model, *law);
    const auto growth = [&](double step) {
        State<2> state = initial_state(model);
        for (int i = 0; i < model.particles.count(); ++i)
            state.velocity[i] = {1e-6 * std::sin(7.0 * i), 1e-6 * std::cos(5.0 * i * i)};
        double size = 0;
        for (int k = 0; k < 3000; ++k) {
            law->forces(state);
            size = 0;
            for (int i = 0; i < model.particles.count(); ++i) {
                state.velocity[i] += step / model.particles.mass[i] * state.force[i];
                state.displacement[i] += step * state.velocity[i];
                size = std::max(size, state.velocity[i].norm());
            }
            if (size > 1) break;  // a million times the start: no need to wait for infinity
        }
        return size / 1e-6;
    };
    EXPECT_LE(growth(0.99 * 2 / omega), 30);
    EXPECT_GE(growth(1.01 * 2 / omega), 1e4);
}

/// Simply the exact solution of a clamped-free bar in pure bending cannot be had here; a cantilever's first
/// frequency by Timoshenko theory (kappa = 10 (1 + nu) / (12 + 11 nu), Cowper 1966) is good to a per cent at
/// L / H = 8.
TEST(Frequency, FirstFrequencyOfASlenderCantilever) {
    // 64 x 8 particles; clamping one column leaves a span of 63.5 spacings from its centre.
    const Model<2> model = plate(64, 8, 0.125);
    std::vector<std::array<bool, 3>> held(model.particles.count(), std::array<bool, 3>{});
    for (const int i : test::where(model, [](const Vec<2>& X) { return X.x() < 0.125; }))
        held[i] = {true, true, false};
    const double omega = first_frequency(model, held);
    const double E = 2.1e8, rho = 2300, H = 1, L = 63.5 * 0.125, I = H * H * H / 12;
    const double bernoulli = std::pow(1.8751041, 2) * std::sqrt(E * I / (rho * H)) / (L * L);
    EXPECT_NEAR(omega / bernoulli, 0.99, 0.015);  // shear and rotary inertia lower it by about 1 %
}

}  // namespace
}  // namespace hibi
