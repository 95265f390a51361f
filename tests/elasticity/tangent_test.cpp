#include "elasticity/tangent.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "algebra/cholesky.hpp"
#include "elasticity/elastic_law.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

class TangentAt : public testing::TestWithParam<double> {};

// Damaged, turned by 0.7 rad, disturbed by 5 % of a spacing: every column against differences of the forces,
// by the five-point formula.
TEST_P(TangentAt, IsTheDerivativeOfTheForcesWithBrokenBonds) {
    Material material = test::concrete();
    material.poissons_ratio = GetParam();
    const Model<2> model = test::plate(7, 6, 0.5, material, Assumption::plane_strain);
    State<2> state = initial_state(model);
    test::break_every_seventh(state);
    const auto law = make_elastic_law<2>(model, Elasticity::moment_matched, state);
    test::turn_and_shake(model, state, 0.7, 0.05);
    const Eigen::MatrixXd K = tangent(model, state);
    const double scale = K.cwiseAbs().maxCoeff(), h = 1e-4;
    ASSERT_GT(scale, 0);
    const int n = model.particles.count();
    const auto forces = [&](int column, double step) {
        double& u = state.displacement[column / 2][column % 2];
        const double keep = u;
        u += step * h;
        law->forces(state);
        u = keep;
        Eigen::VectorXd f(2 * n);
        for (int i = 0; i < n; ++i) f.segment<2>(2 * i) = state.force[i];
        return f;
    };
    const Tangent<2> from_bonds(model, state);
    for (int column = 0; column < 2 * n; ++column) {
        const Eigen::VectorXd derivative =
            (forces(column, -2) - 8 * forces(column, -1) + 8 * forces(column, 1) - forces(column, 2)) /
            (12 * h);
        EXPECT_LT((derivative + K.col(column)).cwiseAbs().maxCoeff(), 1e-7 * scale) << column;
        Eigen::VectorXd y;
        from_bonds.multiply(Eigen::VectorXd::Unit(2 * n, column), y);
        EXPECT_LT((y - K.col(column)).cwiseAbs().maxCoeff(), 1e-14 * scale) << column;
    }
}
INSTANTIATE_TEST_SUITE_P(PoissonsRatio, TangentAt, testing::Values(0, 0.3, 0.49), [](const auto& ratio) {
    return std::to_string(static_cast<int>(100 * ratio.param));
});

// The pattern is found once: what breaks or moves later must find its place in it.
TEST(Tangent, UpdatedAfterBreaksItIsThatOfTheDamagedModel) {
    const Model<2> model = test::plate(6, 5, 1);
    State<2> state = initial_state(model);
    const std::vector<std::array<bool, 3>> held(model.particles.count());
    Tangent<2> kept(model, state);
    kept.assemble(held);
    test::break_every_seventh(state);
    test::turn_and_shake(model, state, 0.3, 0.02);
    kept.update(state);
    const Eigen::MatrixXd lower = kept.assemble(held), expected = tangent(model, state);
    const Eigen::MatrixXd difference = (lower - expected).triangularView<Eigen::Lower>();
    EXPECT_LE(difference.cwiseAbs().maxCoeff(), 1e-15 * expected.cwiseAbs().maxCoeff());
}

TEST(Cholesky, SolvesAndKnowsWhatIsNotPositiveDefinite) {
    const Model<2> model = test::plate(8, 5, 1);
    std::vector<std::array<bool, 3>> held(model.particles.count());
    held[0] = {true, true, false};
    Tangent<2> K(model, initial_state(model));
    Eigen::SparseMatrix<double> lower = K.assemble(held);
    Cholesky cholesky(lower);
    cholesky.factorise(lower);
    EXPECT_LT(cholesky.weakest(lower).ratio, singular_pivot);  // it turns about particle 0
    held[7] = {false, true, false};
    lower = K.assemble(held);
    ASSERT_TRUE(cholesky.factorise(lower));
    EXPECT_GT(cholesky.weakest(lower).ratio, 1e-3);
    const Eigen::VectorXd b = Eigen::VectorXd::Random(lower.rows());
    Eigen::VectorXd x;
    cholesky.solve(b, x);
    const Eigen::VectorXd back = lower.selfadjointView<Eigen::Lower>() * x;
    EXPECT_LT((back - b).norm(), 1e-10 * b.norm());
    lower.coeffRef(20, 20) = -1;
    EXPECT_FALSE(cholesky.factorise(lower));
}

}  // namespace
}  // namespace hibi
