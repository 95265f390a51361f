// The constant of fracture_strain, found by linear statics: an edge-cracked strip, bond after bond broken,
// the load set anew each time; the largest load on the way is that at which the strip fails.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <tuple>

#include "breaking/plane_fracture.hpp"
#include "support/crack.hpp"

namespace hibi {
namespace {

using test::CrackGrowth;
using test::StripCase;

struct Failure {
    double lowest = 0, mean = 0, highest = 0;  ///< K_I at failure over sqrt(Gc E')
};

/// At 20 particles across, the place of the tip between the particles alone moves the failure load by 5 %.
const std::vector<double> tip_places{0, 0.25, 0.5, 0.75};

Failure failure(StripCase c, const std::function<double(double)>& limit, double K_Ic,
                const std::vector<double>& shifts = tip_places) {
    Failure result{.lowest = 1e9};
    for (const double shift : shifts) {
        c.shift_x = shift;
        double load = 0;
        CrackGrowth growth(c, 3.6 + 2 * c.influence, 1.6 + 2 * c.influence, 2 + 2 * c.influence);
        for (const CrackGrowth::Break& b : growth.grow(limit, 3)) load = std::max(load, b.load);
        result.lowest = std::min(result.lowest, load / K_Ic);
        result.highest = std::max(result.highest, load / K_Ic);
        result.mean += load / K_Ic / static_cast<double>(shifts.size());
    }
    return result;
}

/// By the limits the program uses; Gc = 1 J/m^2.
Failure failure(const StripCase& c, const std::vector<double>& shifts = tip_places) {
    const Material m{.name = "unit", .youngs_modulus = 1, .poissons_ratio = c.nu, .fracture_energy = 1};
    const double E = c.assumption == Assumption::plane_stress ? 1 : 1 / (1 - c.nu * c.nu);
    const auto limit = [&](double length) {
        return fracture_strain(m, c.assumption, c.influence, c.spacing(), length);
    };
    return failure(c, limit, std::sqrt(E), shifts);
}

TEST(Calibration, StripBrokenBondByBondIsTheStripSolvedAnew) {
    CrackGrowth growth({.across = 12, .angle = 30, .shift_x = 0.3});
    growth.grow([](double) { return 1.0; }, 2);
    const Eigen::VectorXd slow = growth.slow();
    EXPECT_LE((growth.quick() - slow).norm(), 1e-6 * slow.norm());
}

TEST(Calibration, StripFailsAtTheLoadOfFractureMechanicsAlongTheLatticeAndAcrossIt) {
    // 0.92 and 1.06; the goal of 5 % is for the larger influence, in SlowStrip.
    const double along = failure({.across = 32}).mean, across = failure({.across = 32, .angle = 45}).mean;
    EXPECT_NEAR(along, 1, 0.09);
    EXPECT_NEAR(across, 1, 0.09);
    EXPECT_NEAR(along + across, 2, 0.05);
}

TEST(Calibration, PlaneStrainFailsAtItsOwnToughness) {
    // nu' = nu / (1 - nu) = 0.3: the same strip, but for E and so for K_Ic = sqrt(Gc E / (1 - nu^2)).
    const double stress = failure({.across = 16, .nu = 0.3}, {0.0}).mean;
    const double strain =
        failure({.across = 16, .nu = 0.3 / 1.3, .assumption = Assumption::plane_strain}, {0.0}).mean;
    EXPECT_NEAR(stress, strain, 1e-6);
}

class ConstantOfTheStrip : public testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(ConstantOfTheStrip, IsThatOfTheTable) {
    const auto [influence, nu] = GetParam();
    const Material m{.name = "unit", .youngs_modulus = 1, .poissons_ratio = nu, .fracture_energy = 1};
    const double constant_now = fracture_constant(m, Assumption::plane_stress, influence);
    double lowest = 1e9, highest = 0;
    for (const double angle : {0.0, 45.0}) {
        for (const int across : {20, 40, 80}) {
            const StripCase c{.across = across, .angle = angle, .nu = nu, .influence = influence};
            const auto shape = [&](double length) {  // the limits with C = 1
                return fracture_strain(m, c.assumption, influence, c.spacing(), length) / constant_now;
            };
            const double mean = failure(c, shape, 1).mean;
            lowest = std::min(lowest, mean);
            highest = std::max(highest, mean);
        }
    }
    const double C = 2 / (lowest + highest);
    fmt::print("r_e {} nu' {}: C = {:.3f}, within {:.1f} %\n", influence, nu, C,
               100 * (highest - lowest) / (highest + lowest));
    EXPECT_NEAR(constant_now, C, 0.002 * C);
}

INSTANTIATE_TEST_SUITE_P(Slow, ConstantOfTheStrip,
                         testing::Combine(testing::Values(1.5, 1.8, 2.1, 2.5, 3.1),
                                          testing::Values(0.0, 0.3, 0.45, 0.6, 0.7, 0.82)));

// The more bonds cross a crack, the less the load depends on its direction. Between the rows and the
// diagonals nothing was calibrated: what 15 and 30 degrees are off by is a figure to be known, not one to be
// proud of.
TEST(SlowStrip, FailsAtTheLoadOfFractureMechanicsOverFourfoldRefinement) {
    for (const double influence : {2.1, 3.1}) {
        for (const double angle : {0.0, 45.0, 15.0, 30.0}) {
            const bool calibrated = angle == 0 || angle == 45;
            const double tolerance = influence > 3 ? calibrated ? 0.05 : 0.15 : calibrated ? 0.08 : 0.16;
            for (const int across : {20, 40, 80}) {
                const Failure f = failure({.across = across, .angle = angle, .influence = influence});
                fmt::print("r_e {}, {:2} degrees, {} across: K at failure / K_Ic = {:.3f} [{:.3f} {:.3f}]\n",
                           influence, angle, across, f.mean, f.lowest, f.highest);
                EXPECT_NEAR(f.mean, 1, tolerance);
            }
        }
    }
}

TEST(SlowStrip, ACentreCrackFailsAtTheSameIntensity) {
    for (const double influence : {2.1, 3.1}) {
        for (const double angle : {0.0, 45.0}) {
            const Failure f = failure({.across = 48, .angle = angle, .influence = influence, .centre = true});
            fmt::print("r_e {}, {:2} degrees, centre crack: K at failure / K_Ic = {:.3f}\n", influence, angle,
                       f.mean);
            // Half of it is 7 spacings long: a tip half a spacing further on is 3.5 % in K.
            EXPECT_NEAR(f.mean, 1, influence > 3 ? 0.07 : 0.09);
        }
    }
}

/// Angle to its notch of a crack that has run on by nine spacings (degrees): the line that fits the broken
/// bonds best.
double path_angle(const StripCase& c) {
    const Material m{.name = "unit", .youngs_modulus = 1, .poissons_ratio = c.nu, .fracture_energy = 1};
    CrackGrowth growth(c, 9.6 + 2 * c.influence, 1.6 + 2 * c.influence, 6 + 2 * c.influence);
    const auto limit = [&](double length) {
        return fracture_strain(m, c.assumption, c.influence, c.spacing(), length);
    };
    const std::vector<CrackGrowth::Break> breaks = growth.grow(limit, 9);
    Vec<2> mean = Vec<2>::Zero();
    for (const CrackGrowth::Break& b : breaks) mean += b.middle / static_cast<double>(breaks.size());
    double xx = 0, xy = 0;
    for (const CrackGrowth::Break& b : breaks) {
        const Vec<2> d = b.middle - mean;
        xx += d.x() * d.x();
        xy += d.x() * d.y();
    }
    return std::atan2(xy, xx) * 180 / std::numbers::pi;
}

TEST(SlowStrip, RowsLeadCracksAstrayAndJitterSetsThemFree) {
    for (const double angle : {0.0, 15.0, 30.0, 45.0}) {
        fmt::print("{:2} degrees:", angle);
        for (const double jitter : {0.0, 0.1, 0.2, 0.3}) {
            double sum = 0;
            for (const std::uint64_t seed : {1, 2, 3})
                sum +=
                    std::pow(path_angle({.across = 36, .angle = angle, .jitter = jitter, .seed = seed}), 2);
            const double deviation = std::sqrt(sum / 3);
            fmt::print("  jitter {} {:.1f}", jitter, deviation);
            if (jitter == 0) {
                EXPECT_NEAR(deviation, angle == 45 ? 0 : angle, 3);
            }
            EXPECT_LT(deviation, 40);
        }
        fmt::print("\n");
    }
}

}  // namespace
}  // namespace hibi
