#include "measure/closed_form.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hibi {
namespace {

TEST(ClosedForm, CantileverSatisfiesElasticityAndItsLoads) {
    const double E = 210e9, nu = 0.3, P = 1000, L = 6, H = 1, h = 1e-3;
    const auto u = [&](double x, double y) { return cantilever_displacement(x, y, P, L, H, {E, nu}); };
    const auto stress = [&](double x, double y) {  // xx, yy, xy by central differences
        const Vec<2> dx = (u(x + h, y) - u(x - h, y)) / (2 * h), dy = (u(x, y + h) - u(x, y - h)) / (2 * h);
        const double plane = E / (1 - nu * nu);
        return Vec3(plane * (dx.x() + nu * dy.y()), plane * (dy.y() + nu * dx.x()),
                    E / (2 * (1 + nu)) * (dx.y() + dy.x()));
    };
    for (const double y : {-0.4, 0.0, 0.3}) {
        const Vec3 s = stress(2, y);
        EXPECT_NEAR(s.x(), -P * (L - 2) * y * 12, 20) << "bending moment P (L - x)";
        EXPECT_NEAR(s.y(), 0, 20);
        EXPECT_NEAR(s.z(), 1.5 * P * (1 - 4 * y * y), 20) << "parabola of resultant P";
    }
    EXPECT_NEAR(u(L, 0).y() / (P * L * L * L / (3 * E / 12)), 1 + (4 + 5 * nu) / (8 * L * L), 1e-12);
}

TEST(ClosedForm, PlaneStrainIsStiffer) {
    const PlaneConstants c = plane_strain(2e6, 0.3975);
    EXPECT_NEAR(c.youngs_modulus, 2e6 / (1 - 0.3975 * 0.3975), 1e-3);
    EXPECT_NEAR(c.poissons_ratio, 0.3975 / 0.6025, 1e-12);
}

/// Slender, Timoshenko's beam is Euler's: (k L)^2 = 22.3733 and 3.51602 (any textbook of vibrations).
TEST(ClosedForm, SlenderBeamsVibrateAsEulerSays) {
    const TimoshenkoBeam beam{.length = 1000, .height = 1, .density = 1200, .material = {1e6, 0.3}};
    const double unit = 2 * M_PI * 1000 * 1000 * std::sqrt(12 * 1200 / 1e6);
    EXPECT_NEAR(free_free_period(beam), unit / 22.3733, 1e-5 * unit / 22.3733);
    EXPECT_NEAR(clamped_free_period(beam), unit / 3.51602, 1e-5 * unit / 3.51602);
}

/// First-order effect of turning and shear on the period of a free beam, by Rayleigh's quotient of the slender mode:
/// 1 + (H/L)^2/24 (49.48 + 12.30 E / (kappa G)), with L^2 times the integrals of w'^2 over w^2 and of w'''^2 over
/// w''^2 for k L = 4.73004.
TEST(ClosedForm, ThickBeamsVibrateSlower) {
    const double nu = 0.3, H = 0.02;
    const TimoshenkoBeam beam{.length = 1, .height = H, .density = 1200, .material = {1e6, nu}};
    const double slender = 2 * M_PI * std::sqrt(12 * 1200 / 1e6) / H / 22.37329;
    const double shear = 2 * (1 + nu) * (12 + 11 * nu) / (10 * (1 + nu));
    EXPECT_NEAR((free_free_period(beam) / slender - 1) / (H * H / 24), 49.48 + 12.30 * shear, 0.5);
}

/// Finite elements of the plane: see clamped_plate_period.
TEST(ClosedForm, ClampedPlateOfTheLiterature) {
    EXPECT_NEAR(clamped_plate_period(0.2, 0.02, 2e6, 1000), 0.25522, 1e-5);
    EXPECT_NEAR(clamped_plate_period(0.202, 0.02, 2e6, 1000), 0.26031, 2e-5);
}

TEST(ClosedForm, BarWithoutLateralContractionSwingsWithTheSpeedOfSound) {
    EXPECT_DOUBLE_EQ(bar_period(10, 1, 7800, {210e9, 0}), 20 * std::sqrt(7800 / 210e9));
    EXPECT_NEAR(bar_period(10, 1, 7800, {210e9, 0.3}) / bar_period(10, 1, 7800, {210e9, 0}) - 1, 3.7e-4,
                1e-5);
}

/// Mattiasson, International Journal for Numerical Methods in Engineering 17 (1981) 145, table I: v / L and
/// (L - x) / L.
TEST(ClosedForm, ElasticaMatchesTheTable) {
    const double table[][3] = {
        {1, 0.30172, 0.05643}, {2, 0.49346, 0.16064}, {5, 0.71379, 0.38763}, {10, 0.81061, 0.55500}};
    for (const auto& [load, across, shorter] : table) {
        EXPECT_NEAR(elastica_end(load).y(), across, 1e-5) << load;
        EXPECT_NEAR(1 - elastica_end(load).x(), shorter, 1e-5) << load;
    }
    EXPECT_NEAR(elastica_end(1e-3).y() / 1e-3, 1 / 3.0, 1e-6) << "small loads: P L^3 / (3 E I)";
}

/// Handbook: 1.12 for a short crack; 1.66 at 0.3, 2.83 at a half.
TEST(ClosedForm, EdgeCrackFactor) {
    EXPECT_NEAR(edge_crack_factor(0), 1.12, 1e-12);
    EXPECT_NEAR(edge_crack_factor(0.3), 1.66, 2e-3);
    EXPECT_NEAR(edge_crack_factor(0.5), 2.83, 1e-2);
}

}  // namespace
}  // namespace hibi
