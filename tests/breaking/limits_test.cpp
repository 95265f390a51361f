#include "breaking/limits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "breaking/plane_fracture.hpp"
#include "elasticity/elastic_law.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

using test::plate;
using test::where;

Material breakable(double strain) {
    Material m = test::concrete();
    m.break_strain = strain;
    return m;
}

TEST(Limits, BondBreaksJustPastTheCriticalStretchAndNotBefore) {
    for (const double sign : {1.0, -1.0}) {
        const Model<2> model = plate(2, 1, 1, breakable(0.05));
        ASSERT_EQ(model.bonds.count(), 1);
        const auto law = make_elastic_law<2>(model, Elasticity::moment_matched,
                                             break_limits(model, break_strains(model, {})));
        State<2> state = initial_state(model);
        const auto passed = [&](double strain) {
            state.displacement[1].x() = sign * strain;
            law->update_displacements(state, 0, 2);
            return !law->sum_forces(state).empty();
        };
        EXPECT_FALSE(passed(0.05 - 1e-12));
        EXPECT_TRUE(passed(0.05 + 1e-12));
        state.displacement[1].x() = sign * 0.05;
        EXPECT_NEAR(bond_strain<2>({1, 0}, {sign * 0.05, 0}), sign * 0.05, 1e-16);
    }
}

TEST(Limits, TensionOnlySparesShortenedBonds) {
    Material m = breakable(0.05);
    m.tension_only = true;
    const Model<2> model = plate(2, 1, 1, m);
    const BreakLimits limits = break_limits(model, break_strains(model, {}));
    EXPECT_EQ(limits.lower[0], -std::numeric_limits<double>::infinity());
    EXPECT_DOUBLE_EQ(limits.upper[0], 0.05 * 2.05);
}

TEST(Limits, HeldAndNoFailBondsNeverBreak) {
    const Model<2> model = plate(6, 3, 1, breakable(0.05));
    Physics physics;
    physics.holds = {{"clamp", where(model, [](const Vec<2>& X) { return X.x() < 2; }), {true, true, false}}};
    physics.loads = {test::pull(model, where(model, [](const Vec<2>& X) { return X.x() > 4; }), {1, 0}, 1)};
    physics.loads[0].no_fail = true;
    const std::vector<double> strains = break_strains(model, physics);
    int safe = 0;
    for (int b = 0; b < model.bonds.count(); ++b) {
        const double x = model.particles.reference_position[model.bonds.first[b]].x();
        const double y = model.particles.reference_position[model.bonds.second[b]].x();
        const bool expected = (x < 2 && y < 2) || (x > 4 && y > 4);
        EXPECT_EQ(strains[b] == std::numeric_limits<double>::infinity(), expected);
        safe += expected;
    }
    EXPECT_GT(safe, 0);
}

TEST(Limits, WeibullStrengthsFollowTheirDistributionAndTheirSeed) {
    Material m = breakable(0.1);
    m.weibull = Weibull{.shape = 5, .seed = 3};
    const Model<2> model = plate(60, 60, 1, m);
    std::vector<double> strains = break_strains(model, {});
    EXPECT_EQ(strains, break_strains(model, {}));
    std::sort(strains.begin(), strains.end());
    // Kolmogorov-Smirnov distance to 1 - exp(-(e / 0.1)^5): 1.63 / sqrt(n) at the 1 % level
    double distance = 0;
    const double n = static_cast<double>(strains.size());
    for (std::size_t k = 0; k < strains.size(); ++k)
        distance = std::max(
            distance, std::abs(1 - std::exp(-std::pow(strains[k] / 0.1, 5)) - static_cast<double>(k) / n));
    EXPECT_LE(distance, 1.63 / std::sqrt(n));
    Model<2> other = model;
    other.materials[0].weibull->seed = 4;
    EXPECT_NE(break_strains(other, {}).front(), break_strains(model, {}).front());
}

TEST(Limits, FractureEnergyLimitFallsWithTheRootOfTheSpacing) {
    Material m = test::concrete();
    m.fracture_energy = 100;
    const auto limit = [&](double l0, double length) {
        return fracture_strain(m, Assumption::plane_stress, 2.1, l0, length);
    };
    EXPECT_NEAR(limit(0.01, 0.01) / limit(0.04, 0.04), 2, 1e-12);
    EXPECT_NEAR(limit(0.01, 0.01) / limit(0.01, 0.03), std::pow(2, -0.1), 1e-12);
    const Model<2> model = plate(3, 3, 0.5, m);
    const std::vector<double> strains = break_strains(model, {});
    for (int b = 0; b < model.bonds.count(); ++b)
        EXPECT_DOUBLE_EQ(strains[b], limit(0.5, model.bonds.rest_length[b]));
}

TEST(Limits, PlaneStrainFractureIsPlaneStressOfTheEquivalentConstants) {
    Material strain = test::concrete(), stress = strain;
    strain.fracture_energy = stress.fracture_energy = 100;
    stress.youngs_modulus /= 1 - 0.3 * 0.3;
    stress.poissons_ratio = 0.3 / 0.7;
    EXPECT_NEAR(fracture_strain(strain, Assumption::plane_strain, 2.3, 1, 1),
                fracture_strain(stress, Assumption::plane_stress, 2.3, 1, 1), 1e-15);
    strain.poissons_ratio = 0.45;
    EXPECT_TRUE(fracture_is_calibrated(strain, Assumption::plane_strain, 1.5));
    EXPECT_FALSE(fracture_is_calibrated(strain, Assumption::plane_strain, 3.5));
    strain.poissons_ratio = -0.1;
    EXPECT_FALSE(fracture_is_calibrated(strain, Assumption::plane_strain, 2.1));
}

}  // namespace
}  // namespace hibi
