#include "elasticity/elastic_law.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/parallel.hpp"
#include "elasticity/tangent.hpp"
#include "elasticity/frequency.hpp"
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
    std::unique_ptr<ElasticLaw<2>> law(Model<2>& model) const {
        if (GetParam().elasticity == Elasticity::thesis) model.spin = make_spin(model);
        return make_elastic_law<2>(model, GetParam().elasticity);
    }
    static double force_scale(const Model<2>& model) {
        double largest = 0;
        for (const Vec<2>& f : model.particles.force) largest = std::max(largest, f.norm());
        return largest;
    }
};

TEST_P(EveryLaw, ForceIsTheDerivativeOfTheEnergyWithEverySeventhBondBroken) {
    Model<2> model = body();
    test::break_every_seventh(model);
    const auto law = this->law(model);
    test::turn_and_shake(model, 0.7, 0.05);
    if (model.spin)
        for (int i = 0; i < model.particles.count(); ++i) model.spin->angle[i] = 0.7 + 0.01 * std::sin(i);
    law->forces(model);
    const double scale = force_scale(model);
    ASSERT_GT(scale, 0);
    const double h = 1e-5;  // spacings; five-point formula, error h^4
    const auto derivative = [&](double& x, double step) {
        const double keep = x;
        const auto at = [&](double k) {
            x = keep + k * step;
            const double e = law->energy(model);
            x = keep;
            return e;
        };
        return (at(-2) - 8 * at(-1) + 8 * at(1) - at(2)) / (12 * step);
    };
    for (int i = 0; i < model.particles.count(); i += 5) {
        for (int a = 0; a < 2; ++a) {
            const double force = model.particles.force[i][a];
            EXPECT_NEAR(-derivative(model.particles.displacement[i][a], h), force, 1e-8 * scale)
                << i << " " << a;
        }
        if (model.spin) {
            const double torque = model.spin->torque[i];
            EXPECT_NEAR(-derivative(model.spin->angle[i], h), torque, 1e-8 * scale) << i;
        }
    }
}

TEST_P(EveryLaw, ForcesAndTorquesSumToZero) {
    Model<2> model = body();
    test::break_every_seventh(model);
    const auto law = this->law(model);
    test::turn_and_shake(model, 0.7, 0.05);
    law->forces(model);
    Vec<2> sum = Vec<2>::Zero();
    double moment = 0, scale = 0;
    for (int i = 0; i < model.particles.count(); ++i) {
        const Vec<2> x = model.particles.position(i), f = model.particles.force[i];
        sum += f;
        moment += x.x() * f.y() - x.y() * f.x() + (model.spin ? model.spin->torque[i] : 0);
        scale += f.norm();
    }
    ASSERT_GT(scale, 0);
    EXPECT_LE(sum.norm() / scale, 1e-12);
    EXPECT_LE(std::abs(moment) / (scale * 4), 1e-12);  // lever arms of up to 4 m
}

TEST_P(EveryLaw, RotatedDamagedBodyAtRestFeelsNoForce) {
    for (const double angle : {0.0, 0.7, 1.6, 3.0, 3.14159265358979}) {
        Model<2> model = body();
        test::break_every_seventh(model);
        // fragments: particle 0 keeps one bond, particle 8 none
        for (int k = model.bonds.start[0] + 1; k < model.bonds.start[1]; ++k)
            model.bonds.broken_at[model.bonds.bonds_of[k]] = 0;
        model.bonds.broken_at[model.bonds.bonds_of[model.bonds.start[0]]] = Bonds::intact;
        for (int k = model.bonds.start[8]; k < model.bonds.start[9]; ++k)
            model.bonds.broken_at[model.bonds.bonds_of[k]] = 0;
        const auto law = this->law(model);
        test::turn_and_shake(model, angle, 0);
        if (model.spin) model.spin->angle.assign(model.particles.count(), angle);
        law->forces(model);
        const double stiffness = 2.1e8 * 0.5;  // E l0 per unit thickness: the force of a strain of one
        EXPECT_LE(force_scale(model) / stiffness, 1e-12) << angle;
        EXPECT_LE(law->energy(model) / stiffness, 1e-20) << angle;
    }
}

TEST_P(EveryLaw, SmallStrainsKeepTheirDigits) {
    // A force at a strain of 1e-12 is 1e-6 of that at 1e-6: to eight digits, far from any rounding of
    // positions.
    Model<2> model = body();
    const auto law = this->law(model);
    const auto force = [&](double size) {
        test::turn_and_shake(model, 0, size);
        law->forces(model);
        return model.particles.force;
    };
    const auto small = force(1e-12), large = force(1e-6);
    double scale = 0;
    for (const Vec<2>& f : large) scale = std::max(scale, f.norm());
    ASSERT_GT(scale, 0);
    for (std::size_t i = 0; i < large.size(); ++i)
        EXPECT_LE((1e6 * small[i] - large[i]).norm(), 3e-6 * scale) << i;
}

TEST_P(EveryLaw, ASmallRotationIsForceFreeToItsOwnRounding) {
    Model<2> model = body();
    const auto law = this->law(model);
    const double angle = 1e-5;
    for (int i = 0; i < model.particles.count(); ++i) {
        const Vec<2>& X = model.particles.reference_position[i];
        const double c1 = -2 * std::pow(std::sin(angle / 2), 2), s = std::sin(angle);
        model.particles.displacement[i] = {c1 * X.x() - s * X.y(), s * X.x() + c1 * X.y()};
    }
    if (model.spin) model.spin->angle.assign(model.particles.count(), angle);
    law->forces(model);
    // A cos - 1 taken from cos alone is off by 1e-16, and leaves 6e-18 here.
    EXPECT_LE(force_scale(model) / (2.1e8 * 0.5), 1e-13 * angle);
}

TEST_P(EveryLaw, TimeStepEstimateLiesJustBelowTheTrueLimit) {
    Model<2> model = body(12, 5);
    const auto law = this->law(model);
    const double estimate = highest_frequency(model, *law);
    // The true limit, slowly: the dense matrix of all forces by unit displacements.
    const int n = model.particles.count(), per = model.spin ? 3 : 2;
    Eigen::MatrixXd K(per * n, per * n);
    const double h = 1e-8;
    for (int k = 0; k < per * n; ++k) {
        const int i = k / per, a = k % per;
        double& x = a < 2 ? model.particles.displacement[i][a] : model.spin->angle[i];
        const double inertia = a < 2 ? model.particles.mass[i] : model.spin->inertia[i];
        x = h;
        law->forces(model);
        x = 0;
        for (int j = 0; j < n; ++j) {
            for (int b = 0; b < 2; ++b)
                K(per * j + b, k) =
                    -model.particles.force[j][b] / h / std::sqrt(inertia * model.particles.mass[j]);
            if (per == 3)
                K(3 * j + 2, k) = -model.spin->torque[j] / h / std::sqrt(inertia * model.spin->inertia[j]);
        }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen((K + K.transpose()) / 2);
    const double exact = std::sqrt(eigen.eigenvalues().maxCoeff());
    EXPECT_LE(estimate, exact * (1 + 1e-6));
    EXPECT_GE(estimate, exact * 0.99);
    EXPECT_GE(eigen.eigenvalues().minCoeff(), -1e-6 * exact * exact);  // no mode grows by itself
    if (GetParam().elasticity == Elasticity::moment_matched) {
        const double bound = frequency_bound(model);
        EXPECT_GE(bound, exact);
        EXPECT_LE(bound, exact * 1.45);
        // the assembled tangent is that very matrix
        const Eigen::MatrixXd T = tangent(model);
        EXPECT_LE((T / model.particles.mass[0] - K).norm() / K.norm(), 1e-6);
    }
}

TEST(TimeStep, EstimateHoldsForAStiffInclusionOfAThousandTimes) {
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
    Eigen::MatrixXd K = tangent(model);
    K /= model.particles.mass[0];
    const double exact =
        std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(K).eigenvalues().maxCoeff());
    EXPECT_LE(estimate, exact * (1 + 1e-6));
    EXPECT_GE(estimate, exact * 0.99);
    EXPECT_GE(frequency_bound(model), exact);
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
    Model<2> model = plate(20, 12, 0.25);
    const auto law = make_elastic_law<2>(model, Elasticity::moment_matched);
    Mat<2> U, R;
    U << 1.02, 0.004, 0.004, 0.99;
    R << std::cos(0.5), -std::sin(0.5), std::sin(0.5), std::cos(0.5);
    for (int i = 0; i < model.particles.count(); ++i) {
        const Vec<2>& X = model.particles.reference_position[i];
        model.particles.displacement[i] = R * U * X - X;
    }
    const Mat<2> strain = U - Mat<2>::Identity();
    const double mu = shear_modulus(model.materials[0]),
                 lambda = lame_lambda(model.materials[0], model.assumption);
    const Mat<2> stress =
        R * (2 * mu * strain + lambda * strain.trace() * Mat<2>::Identity()) * R.transpose();
    for (const int i : test::where(model, [](const Vec<2>& X) {
             return X.x() > 0.75 && X.x() < 4.25 && X.y() > 0.75 && X.y() < 2.25;
         }))
        EXPECT_LE((law->local(model, i).stress - stress).norm(), 1e-8 * stress.norm()) << i;
    const double density = mu * strain.squaredNorm() + lambda / 2 * std::pow(strain.trace(), 2);
    EXPECT_NEAR(law->energy(model), density * 20 * 12 * 0.25 * 0.25, 1e-4 * law->energy(model));
}

/// What a bar carries: E A strain; no strain across the plane makes it E / (1 - nu^2).
TEST(MomentMatched, ASingleRowOrColumnOfParticlesIsABar) {
    for (const Assumption assumption : {Assumption::plane_stress, Assumption::plane_strain})
        for (const int axis : {0, 1}) {
            Material material = test::concrete();
            Model<2> model = axis == 0 ? plate(20, 1, 0.25, material, assumption)
                                       : plate(1, 20, 0.25, material, assumption);
            const auto law = make_elastic_law<2>(model, Elasticity::moment_matched);
            const double strain = 1e-3;
            for (int i = 0; i < model.particles.count(); ++i)
                model.particles.displacement[i][axis] = strain * model.particles.reference_position[i][axis];
            law->forces(model);
            double carried = 0;  // through the middle
            for (const int i : test::where(model, [&](const Vec<2>& X) { return X[axis] < 2.5; }))
                carried += model.particles.force[i][axis];
            const double E = 2.1e8 / (assumption == Assumption::plane_strain ? 1 - 0.3 * 0.3 : 1);
            EXPECT_NEAR(carried, E * 0.25 * strain, 1e-9 * carried) << axis;
            EXPECT_NEAR(law->local(model, 10).stress(axis, axis), E * strain, 1e-9 * E * strain);
            // Nor does an estimate of the time step or of a first mode see another body.
            Model<2> at_rest = model;
            for (Vec<2>& u : at_rest.particles.displacement) u.setZero();
            const auto K = tangent(at_rest);
            Eigen::VectorXd u = Eigen::VectorXd::Zero(K.cols());
            for (int i = 0; i < model.particles.count(); ++i)
                u[2 * i + axis] = model.particles.displacement[i][axis];
            const Eigen::VectorXd f = K * u;
            for (int i = 0; i < model.particles.count(); ++i)
                EXPECT_NEAR(-f[2 * i + axis], model.particles.force[i][axis], 1e-9 * carried) << i;
        }
}

TEST(Weights, MomentsMatchWherePossibleAndFactorsStayBounded) {
    const Model<2> model = plate(8, 6, 1);
    const BondWeights s = moment_matched_weights(model);
    int exact = 0;
    for (int i = 0; i < model.particles.count(); ++i) {
        Mat<2> moment = Mat<2>::Zero();
        for (int k = model.bonds.start[i]; k < model.bonds.start[i + 1]; ++k) {
            const int b = model.bonds.bonds_of[k], j = model.bonds.other(b, i);
            const Vec<2> n =
                (model.particles.reference_position[j] - model.particles.reference_position[i]).normalized();
            const double share = model.bonds.first[b] == i ? s.forward[b] : s.backward[b];
            EXPECT_GT(share, 0);
            moment += share / model.particles.volume[i] * n * n.transpose();
        }
        if ((moment - Mat<2>::Identity()).norm() < 1e-9) ++exact;
    }
    EXPECT_GE(exact, model.particles.count() - 4);  // all but the corners
}

TEST(Weights, ReferenceNumberDensityOfTheSquareLattice) {
    // r_e = 2.1: 4 neighbours at 1, 4 at sqrt 2, 4 at 2
    EXPECT_NEAR(reference_number_density<2>(2.1), 4 * 1.1 + 4 * (2.1 / std::sqrt(2.0) - 1) + 4 * 0.05, 1e-12);
}

TEST(Weights, NodalAreasOfAFaceSumToItAndAlternate) {
    const Model<2> model = plate(30, 7, 1);
    const std::vector<Vec<2>> A = nodal_areas(model);
    const auto sum = [&](double from, double to) {
        double area = 0;
        for (const int i : test::where(model, [&](const Vec<2>& X) { return X.x() > from && X.x() < to; }))
            area += A[i].x();
        return area;
    };
    // physics.md section 4, columns from the face: +10.37, -3.25, -0.12, together the height 7
    EXPECT_NEAR(sum(29, 30), 10.37, 0.01);
    EXPECT_NEAR(sum(28, 29), -3.25, 0.01);
    EXPECT_NEAR(sum(27, 28), -0.12, 0.01);
    EXPECT_NEAR(sum(15, 30), 7, 1e-9);
    EXPECT_LE(std::abs(sum(14, 15)), 1e-9);
}

}  // namespace
}  // namespace hibi
