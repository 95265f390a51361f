// Bodies whose lattice is turned or jittered.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "elasticity/elastic_law.hpp"
#include "elasticity/weights.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

constexpr double degree = std::numbers::pi / 180;

class AnyLattice : public testing::TestWithParam<Lattice> {
 protected:
    Model<2> model = [] {
        Model<2> plate;
        plate.materials = {test::concrete()};
        add_body<2>(
            plate,
            {.name = "plate", .shape = {Box<2>{{0, 0}, {20, 12}}}, .spacing = 0.5, .lattice = GetParam()});
        connect<2>(plate, {});
        return plate;
    }();
};

TEST_P(AnyLattice, MomentsSumToTheVolume) {
    const BondWeights s = moment_matched_weights(model);
    std::vector<Mat<2>> moment(model.particles.count(), Mat<2>::Zero());
    for (int b = 0; b < model.bonds.count(); ++b) {
        const int i = model.bonds.first[b], j = model.bonds.second[b];
        const Vec<2> n =
            (model.particles.reference_position[j] - model.particles.reference_position[i]).normalized();
        moment[i] += s.forward[b] * n * n.transpose() / model.particles.volume[i];
        moment[j] += s.backward[b] * n * n.transpose() / model.particles.volume[j];
    }
    int exact = 0;
    for (const Mat<2>& m : moment) exact += (m - Mat<2>::Identity()).norm() < 1e-9;
    EXPECT_GE(exact, 0.98 * model.particles.count());  // the rest has a clamped factor
}

TEST_P(AnyLattice, ARotatedBodyFeelsNoForceAndAnAffineOneTheExactStress) {
    const auto law = make_elastic_law<2>(model, Elasticity::moment_matched);
    State<2> state = initial_state(model);
    test::turn_and_shake(model, state, 0.7, 0);
    law->forces(state);
    for (const Vec<2>& f : state.force) EXPECT_LE(f.norm(), 1e-12 * 2.1e8);
    Mat<2> strain;
    strain << 1e-7, 3e-8, 3e-8, -2e-7;
    for (int i = 0; i < model.particles.count(); ++i)
        state.displacement[i] = strain * model.particles.reference_position[i];
    law->forces(state);
    const double mu = shear_modulus(model.materials[0]),
                 lambda = lame_lambda(model.materials[0], model.assumption);
    const Mat<2> stress = 2 * mu * strain + lambda * strain.trace() * Mat<2>::Identity();
    const std::vector<int> interior = test::where(
        model, [](const Vec<2>& X) { return X.x() > 1.5 && X.x() < 18.5 && X.y() > 1.5 && X.y() < 10.5; });
    ASSERT_GT(interior.size(), 100u);
    for (const int i : interior)
        EXPECT_LE((law->local(state, i).stress - stress).norm(), 1e-6 * stress.norm()) << i;
}

INSTANTIATE_TEST_SUITE_P(Lattices, AnyLattice,
                         testing::Values(Lattice{}, Lattice{15 * degree}, Lattice{45 * degree},
                                         Lattice{0, 0.1, 1}, Lattice{30 * degree, 0.2, 5}));

}  // namespace
}  // namespace hibi
