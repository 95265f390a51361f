#include "elasticity/elastic_law.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "elasticity/frequency.hpp"
#include "elasticity/tangent.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

using test::plate;

struct Law {
    const char* name;
    Elasticity elasticity;
    double poissons_ratio;
    Assumption assumption;
};
void PrintTo(const Law& law, std::ostream* out) { *out << law.name; }

class EveryLaw : public testing::TestWithParam<Law> {
 protected:
    Model<2> body(int columns = 9, int rows = 7) const {
        Material material = test::concrete();
        material.poissons_ratio = GetParam().poissons_ratio;
        Model<2> model = plate(columns, rows, 0.5, material, GetParam().assumption);
        return model;
    }
    /// Without the bonds that are broken in the state, to which it gives angles where it has them.
    std::unique_ptr<ElasticLaw<2>> law(const Model<2>& model, State<2>& state) const {
        std::unique_ptr<ElasticLaw<2>> law = make_elastic_law<2>(model, GetParam().elasticity, state);
        law->start(state, std::vector<std::array<bool, 3>>(model.particles.count()));
        return law;
    }
    static double force_scale(const State<2>& state) {
        double largest = 0;
        for (const Vec<2>& f : state.force) largest = std::max(largest, f.norm());
        return largest;
    }
};

TEST_P(EveryLaw, ForceIsTheDerivativeOfTheEnergyWithEverySeventhBondBroken) {
    const Model<2> model = body();
    State<2> state = initial_state(model);
    test::break_every_seventh(state);
    const auto law = this->law(model, state);
    test::turn_and_shake(model, state, 0.7, 0.05);
    if (state.has_spin())
        for (int i = 0; i < model.particles.count(); ++i) state.angle[i] = 0.7 + 0.01 * std::sin(i);
    law->forces(state);
    const double scale = force_scale(state);
    ASSERT_GT(scale, 0);
    const double h = 1e-5;  // spacings; five-point formula, error h^4
    const auto derivative = [&](double& x, double step) {
        const double keep = x;
        const auto at = [&](double k) {
            x = keep + k * step;
            const double e = law->energy(state);
            x = keep;
            return e;
        };
        return (at(-2) - 8 * at(-1) + 8 * at(1) - at(2)) / (12 * step);
    };
    for (int i = 0; i < model.particles.count(); i += 5) {
        for (int a = 0; a < 2; ++a) {
            const double force = state.force[i][a];
            EXPECT_NEAR(-derivative(state.displacement[i][a], h), force, 1e-8 * scale)
                << i << " " << a;
        }
        if (state.has_spin()) {
            const double torque = state.torque[i];
            EXPECT_NEAR(-derivative(state.angle[i], h), torque, 1e-8 * scale) << i;
        }
    }
}

TEST_P(EveryLaw, ForcesAndTorquesSumToZero) {
    const Model<2> model = body();
    State<2> state = initial_state(model);
    test::break_every_seventh(state);
    const auto law = this->law(model, state);
    test::turn_and_shake(model, state, 0.7, 0.05);
    law->forces(state);
    Vec<2> sum = Vec<2>::Zero();
    double moment = 0, scale = 0;
    for (int i = 0; i < model.particles.count(); ++i) {
        const Vec<2> x = position(model, state, i), f = state.force[i];
        sum += f;
        moment += x.x() * f.y() - x.y() * f.x() + (state.has_spin() ? state.torque[i] : 0);
        scale += f.norm();
    }
    ASSERT_GT(scale, 0);
    EXPECT_LE(sum.norm() / scale, 1e-12);
    EXPECT_LE(std::abs(moment) / (scale * 4), 1e-12);  // lever arms of up to 4 m
}

TEST_P(EveryLaw, RotatedDamagedBodyAtRestFeelsNoForce) {
    for (const double angle : {0.0, 0.7, 1.6, 3.0, 3.14159265358979}) {
        const Model<2> model = body();
        State<2> state = initial_state(model);
        test::break_every_seventh(state);
        // fragments: particle 0 keeps one bond, particle 8 none
        for (int k = model.bonds.start[0] + 1; k < model.bonds.start[1]; ++k)
            state.broken_at[model.bonds.bonds_of[k]] = 0;
        state.broken_at[model.bonds.bonds_of[model.bonds.start[0]]] = Bonds::intact;
        for (int k = model.bonds.start[8]; k < model.bonds.start[9]; ++k)
            state.broken_at[model.bonds.bonds_of[k]] = 0;
        const auto law = this->law(model, state);
        test::turn_and_shake(model, state, angle, 0);
        if (state.has_spin()) state.angle.assign(model.particles.count(), angle);
        law->forces(state);
        const double stiffness = 2.1e8 * 0.5;  // E l0 per unit thickness: the force of a strain of one
        EXPECT_LE(force_scale(state) / stiffness, 1e-12) << angle;
        EXPECT_LE(law->energy(state) / stiffness, 1e-20) << angle;
    }
}

TEST_P(EveryLaw, SmallStrainsKeepTheirDigits) {
    // A force at a strain of 1e-12 is 1e-6 of that at 1e-6: to eight digits, far from any rounding of
    // positions.
    const Model<2> model = body();
    State<2> state = initial_state(model);
    const auto law = this->law(model, state);
    const auto force = [&](double size) {
        test::turn_and_shake(model, state, 0, size);
        law->forces(state);
        return state.force;
    };
    const auto small = force(1e-12), large = force(1e-6);
    double scale = 0;
    for (const Vec<2>& f : large) scale = std::max(scale, f.norm());
    ASSERT_GT(scale, 0);
    for (std::size_t i = 0; i < large.size(); ++i)
        EXPECT_LE((1e6 * small[i] - large[i]).norm(), 3e-6 * scale) << i;
}

TEST_P(EveryLaw, ASmallRotationIsForceFreeToItsOwnRounding) {
    const Model<2> model = body();
    State<2> state = initial_state(model);
    const auto law = this->law(model, state);
    const double angle = 1e-5;
    for (int i = 0; i < model.particles.count(); ++i) {
        const Vec<2>& X = model.particles.reference_position[i];
        const double c1 = -2 * std::pow(std::sin(angle / 2), 2), s = std::sin(angle);
        state.displacement[i] = {c1 * X.x() - s * X.y(), s * X.x() + c1 * X.y()};
    }
    if (state.has_spin()) state.angle.assign(model.particles.count(), angle);
    law->forces(state);
    // A cos - 1 taken from cos alone is off by 1e-16, and leaves 6e-18 here.
    EXPECT_LE(force_scale(state) / (2.1e8 * 0.5), 1e-13 * angle);
}

TEST_P(EveryLaw, TimeStepEstimateLiesJustBelowTheTrueLimit) {
    const Model<2> model = body(12, 5);
    State<2> state = initial_state(model);
    const auto law = this->law(model, state);
    const double estimate = highest_frequency(model, *law);
    // The true limit, slowly: the dense matrix of all forces by unit displacements.
    const int n = model.particles.count(), per = state.has_spin() ? 3 : 2;
    Eigen::MatrixXd K(per * n, per * n);
    const double h = 1e-8;
    for (int k = 0; k < per * n; ++k) {
        const int i = k / per, a = k % per;
        double& x = a < 2 ? state.displacement[i][a] : state.angle[i];
        const double inertia = a < 2 ? model.particles.mass[i] : law->spin_inertia(i);
        x = h;
        law->forces(state);
        x = 0;
        for (int j = 0; j < n; ++j) {
            for (int b = 0; b < 2; ++b)
                K(per * j + b, k) =
                    -state.force[j][b] / h / std::sqrt(inertia * model.particles.mass[j]);
            if (per == 3)
                K(3 * j + 2, k) = -state.torque[j] / h / std::sqrt(inertia * law->spin_inertia(j));
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen((K + K.transpose()) / 2);
    const double exact = std::sqrt(eigen.eigenvalues().maxCoeff());
    EXPECT_LE(estimate, exact * (1 + 1e-6));
    EXPECT_GE(estimate, exact * 0.99);
    EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-6 * exact * exact);  // no mode grows by itself
    if (GetParam().elasticity == Elasticity::moment_matched) {
        const double bound = frequency_bound(model, state);
        EXPECT_GE(bound, exact);
        EXPECT_LE(bound, exact * 1.45);
        // the assembled tangent is that very matrix
        const Eigen::MatrixXd T = tangent(model, state);
        EXPECT_LE((T / model.particles.mass[0] - K).norm() / K.norm(), 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, EveryLaw,
    testing::Values(Law{"moment_matched_03", Elasticity::moment_matched, 0.3, Assumption::plane_stress},
                    Law{"moment_matched_0", Elasticity::moment_matched, 0, Assumption::plane_stress},
                    Law{"moment_matched_049_strain", Elasticity::moment_matched, 0.49,
                        Assumption::plane_strain},
                    Law{"thesis_03", Elasticity::thesis, 0.3, Assumption::plane_stress},
                    Law{"thesis_03_strain", Elasticity::thesis, 0.3, Assumption::plane_strain}),
    [](const auto& law) { return std::string(law.param.name); });

/// Affine deformation F = R U: interior stress R (2 mu (U - I) + lambda tr(U - I) I) R^T, exact for these
/// weights.
TEST(MomentMatched, AffineDeformationGivesTheExactStressAndEnergy) {
    const Model<2> model = plate(20, 12, 0.25);
    State<2> state = initial_state(model);
    const auto law = make_elastic_law<2>(model, Elasticity::moment_matched);
    Mat<2> U, R;
    U << 1.02, 0.004, 0.004, 0.99;
    R << std::cos(0.5), -std::sin(0.5), std::sin(0.5), std::cos(0.5);
    for (int i = 0; i < model.particles.count(); ++i) {
        const Vec<2>& X = model.particles.reference_position[i];
        state.displacement[i] = R * U * X - X;
    }
    const Mat<2> strain = U - Mat<2>::Identity();
    const double mu = shear_modulus(model.materials[0]),
                 lambda = lame_lambda(model.materials[0], model.assumption);
    const Mat<2> stress =
        R * (2 * mu * strain + lambda * strain.trace() * Mat<2>::Identity()) * R.transpose();
    for (const int i : test::where(model, [](const Vec<2>& X) {
             return X.x() > 0.75 && X.x() < 4.25 && X.y() > 0.75 && X.y() < 2.25;
         }))
        EXPECT_LE((law->local(state, i).stress - stress).norm(), 1e-8 * stress.norm()) << i;
    const double density = mu * strain.squaredNorm() + lambda / 2 * std::pow(strain.trace(), 2);
    EXPECT_NEAR(law->energy(state), density * 20 * 12 * 0.25 * 0.25, 1e-4 * law->energy(state));
}

/// What a bar carries: E A strain; no strain across the plane makes it E / (1 - nu^2).
TEST(MomentMatched, ASingleRowOrColumnOfParticlesIsABar) {
    for (const Assumption assumption : {Assumption::plane_stress, Assumption::plane_strain})
        for (const int axis : {0, 1}) {
            Material material = test::concrete();
            const Model<2> model = axis == 0 ? plate(20, 1, 0.25, material, assumption)
                                       : plate(1, 20, 0.25, material, assumption);
            State<2> state = initial_state(model);
            const auto law = make_elastic_law<2>(model, Elasticity::moment_matched);
            const double strain = 1e-3;
            for (int i = 0; i < model.particles.count(); ++i)
                state.displacement[i][axis] = strain * model.particles.reference_position[i][axis];
            law->forces(state);
            double carried = 0;  // through the middle
            for (const int i : test::where(model, [&](const Vec<2>& X) { return X[axis] < 2.5; }))
                carried += state.force[i][axis];
            const double E = 2.1e8 / (assumption == Assumption::plane_strain ? 1 - 0.3 * 0.3 : 1);
            EXPECT_NEAR(carried, E * 0.25 * strain, 1e-9 * carried) << axis;
            EXPECT_NEAR(law->local(state, 10).stress(axis, axis), E * strain, 1e-9 * E * strain);
            // Nor does an estimate of the time step or of a first mode see another body.
            const auto K = tangent(model, initial_state(model));
            Eigen::VectorXd u = Eigen::VectorXd::Zero(K.cols());
            for (int i = 0; i < model.particles.count(); ++i)
                u[2 * i + axis] = state.displacement[i][axis];
            const Eigen::VectorXd f = K * u;
            for (int i = 0; i < model.particles.count(); ++i)
                EXPECT_NEAR(-f[2 * i + axis], state.force[i][axis], 1e-9 * carried) << i;
        }
}

}  // namespace
}  // namespace hibi
