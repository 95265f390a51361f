#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "results/snapshot.hpp"

namespace hibi {
namespace {

/// One particle under the given stress xx, yy, zz, xy, yz, xz (Pa).
Snapshot stressed(const std::array<float, 6>& stress) {
    Snapshot s;
    s.displacement = {Vec3(3, -4, 0)};
    s.velocity = {Vec3(1, 2, 2)};
    s.bond_strain = {-0.25f};
    s.damage = {0.5f};
    s.energy = {7.0f};
    s.stress = {stress};
    return s;
}

float value(const std::string& name, const std::array<float, 6>& stress, int dimension = 2) {
    Topology topology;
    topology.dimension = dimension;
    return scalar_field(topology, stressed(stress), name).at(0);
}

TEST(ScalarField, EveryNameGivesOneNumberPerParticleAndALabel) {
    ASSERT_EQ(scalar_field_names().size(), 13u);
    for (const std::string& name : scalar_field_names()) {
        EXPECT_EQ(scalar_field({}, stressed({}), name).size(), 1u) << name;
        EXPECT_FALSE(field_label(name).title.empty()) << name;
    }
}

TEST(ScalarField, UnknownNameIsRefused) {
    EXPECT_THROW(scalar_field({}, stressed({}), "stress"), std::out_of_range);
    EXPECT_THROW(field_label("stress"), std::out_of_range);
}

TEST(ScalarField, VectorsGiveTheirMagnitudeAndComponents) {
    EXPECT_EQ(value("displacement", {}), 5);  // 3-4-5
    EXPECT_EQ(value("displacement_x", {}), 3);
    EXPECT_EQ(value("displacement_y", {}), -4);
    EXPECT_EQ(value("velocity", {}), 3);  // 1-2-2-3
}

TEST(ScalarField, RecordedScalarsPassUnchanged) {
    EXPECT_EQ(value("bond_strain", {}), -0.25f);
    EXPECT_EQ(value("damage", {}), 0.5f);
    EXPECT_EQ(value("energy", {}), 7.0f);
}

TEST(ScalarField, StressComponentsAreNotMixedUp) {
    const std::array<float, 6> stress = {1, 2, 3, 4, 5, 6};
    EXPECT_EQ(value("stress_xx", stress), 1);
    EXPECT_EQ(value("stress_yy", stress), 2);
    EXPECT_EQ(value("stress_xy", stress), 4);
}

TEST(ScalarField, PlainTensionHasItselfAsVonMisesAndPrincipalStressAndAThirdAsTension) {
    const std::array<float, 6> tension = {6e6f, 0, 0, 0, 0, 0};
    EXPECT_FLOAT_EQ(value("von_mises", tension), 6e6f);
    EXPECT_FLOAT_EQ(value("principal_stress", tension), 6e6f);
    EXPECT_FLOAT_EQ(value("pressure", tension), -2e6f);
}

TEST(ScalarField, PureShearHasRootThreeTimesItselfAsVonMisesStress) {
    for (const int component : {3, 4, 5}) {
        std::array<float, 6> shear{};
        shear[component] = 2e6f;
        EXPECT_FLOAT_EQ(value("von_mises", shear, 3), static_cast<float>(2e6 * std::sqrt(3.0)));
        EXPECT_FLOAT_EQ(value("principal_stress", shear, 3), 2e6f);  // principal stresses t, 0, -t
        EXPECT_FLOAT_EQ(value("pressure", shear, 3), 0);
    }
}

TEST(ScalarField, EqualPressureHasNoVonMisesStress) {
    EXPECT_FLOAT_EQ(value("von_mises", {-5, -5, -5, 0, 0, 0}, 3), 0);
    EXPECT_FLOAT_EQ(value("pressure", {-5, -5, -5, 0, 0, 0}, 3), 5);
}

TEST(ScalarField, PrincipalStressOfThePlaneIgnoresTheStressAcrossIt) {
    const std::array<float, 6> pressed = {-2, -4, 0, 0, 0, 0};
    EXPECT_FLOAT_EQ(value("principal_stress", pressed, 2), -2);
    EXPECT_FLOAT_EQ(value("principal_stress", pressed, 3), 0);
}

}  // namespace
}  // namespace hibi
