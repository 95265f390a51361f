#include "elasticity/weights.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/plates.hpp"

namespace hibi {
namespace {

using test::plate;

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
