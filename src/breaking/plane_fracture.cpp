#include "breaking/plane_fracture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "breaking/limits.hpp"

namespace hibi {

namespace {

// Printed, and compared with these, by the tests ConstantOfTheStrip. In the plane a body depends on mu and
// lambda alone, so plane strain is plane stress of nu' = nu / (1 - nu) and E' = E / (1 - nu^2): one table
// serves both.
constexpr std::array calibrated_nu{0.0, 0.3, 0.45, 0.6, 0.7, 0.82};  // nu'
constexpr std::array calibrated_influence{1.5, 1.8, 2.1, 2.5, 3.1};
constexpr double calibrated_constant[calibrated_nu.size()][calibrated_influence.size()]{
    {0.680, 0.692, 0.696, 0.704, 0.692},  // nu' = 0
    {0.530, 0.525, 0.629, 0.656, 0.666}, {0.451, 0.461, 0.577, 0.613, 0.629},
    {0.468, 0.419, 0.504, 0.556, 0.583}, {0.402, 0.420, 0.438, 0.504, 0.530},
    {0.344, 0.343, 0.363, 0.415, 0.438}};

double plane_stress_nu(const Material& m, Assumption assumption) {
    const double nu = m.poissons_ratio;
    return assumption == Assumption::plane_stress ? nu : nu / (1 - nu);
}

/// Interval of rising nodes that holds x, and how far along it x lies, 0..1; x beyond the nodes is clamped.
template <std::size_t Count>
std::pair<std::size_t, double> place_among(const std::array<double, Count>& nodes, double x) {
    std::size_t k = 0;
    while (k + 2 < Count && x > nodes[k + 1]) ++k;
    return {k, std::clamp((x - nodes[k]) / (nodes[k + 1] - nodes[k]), 0.0, 1.0)};
}

}  // namespace

double fracture_constant(const Material& material, Assumption assumption, double influence) {
    const auto [i, s] = place_among(calibrated_nu, plane_stress_nu(material, assumption));
    const auto [j, t] = place_among(calibrated_influence, influence);
    const auto& C = calibrated_constant;
    return (1 - s) * ((1 - t) * C[i][j] + t * C[i][j + 1]) +
           s * ((1 - t) * C[i + 1][j] + t * C[i + 1][j + 1]);
}

bool fracture_is_calibrated(const Material& material, Assumption assumption, double influence) {
    const double nu = plane_stress_nu(material, assumption);
    return nu >= calibrated_nu.front() && nu <= calibrated_nu.back() &&
           influence >= calibrated_influence.front() && influence <= calibrated_influence.back();
}

double fracture_strain(const Material& material, Assumption assumption, double influence, double l0,
                       double length) {
    const double nu = material.poissons_ratio;
    const double stiffness =
        material.youngs_modulus / (assumption == Assumption::plane_stress ? 1 : 1 - nu * nu);
    return fracture_constant(material, assumption, influence) *
           std::pow(std::min(length / l0, std::sqrt(2.0)), 0.2) *
           std::sqrt(*material.fracture_energy / (stiffness * l0));
}

template <>
double fracture_strain<2>(const Model<2>& model, const Material& material, double l0, double length) {
    return fracture_strain(material, model.assumption, model.influence, l0, length);
}

}  // namespace hibi
