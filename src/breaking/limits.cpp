#include "breaking/limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/hash.hpp"
#include "loads/supports.hpp"

namespace hibi {

namespace {
constexpr double never = std::numeric_limits<double>::infinity();
}

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

template <int Dim>
std::vector<double> break_strains(const Model<Dim>& model, const Physics& physics) {
    const Particles<Dim>& particles = model.particles;
    const HeldComponents held = held_by_supports(particles.count(), physics);
    std::vector<char> gripped(particles.count(), 0);
    for (const Load& load : physics.loads)
        if (load.no_fail)
            for (const int i : load.particles) gripped[i] = 1;
    const auto safe = [&](int i) { return all_held<Dim>(held[i]); };

    const auto limit = [&](const Material& m, double l0, double length) {
        if (m.break_strain) return *m.break_strain;
        if (m.fracture_energy) return fracture_strain(m, model.assumption, model.influence, l0, length);
        return never;
    };
    const Bonds& bonds = model.bonds;
    std::vector<double> strains(bonds.count(), never);
    for (int b = 0; b < bonds.count(); ++b) {
        const int i = bonds.first[b], j = bonds.second[b];
        if ((safe(i) && safe(j)) || (gripped[i] && gripped[j])) continue;
        const Material* weaker = &model.materials[particles.material[i]];
        const Material* other = &model.materials[particles.material[j]];
        const double l0 = particles.spacing[i], length = bonds.rest_length[b];  // bonded bodies share l0
        if (limit(*other, l0, length) < limit(*weaker, l0, length)) weaker = other;
        strains[b] = limit(*weaker, l0, length);
        if (weaker->weibull) {
            // Keyed by the two particles, so that the strength does not depend on how the bonds are numbered.
            const std::uint64_t key =
                mix_bits(mix_bits(weaker->weibull->seed) ^ (std::uint64_t(i) << 32 | std::uint32_t(j)));
            strains[b] *= std::pow(-std::log(unit_random(key)), 1 / weaker->weibull->shape);
        }
    }
    return strains;
}

template <int Dim>
BreakLimits break_limits(const Model<Dim>& model, const std::vector<double>& strains) {
    BreakLimits limits{std::vector<double>(strains.size(), never),
                       std::vector<double>(strains.size(), -never)};
    for (std::size_t b = 0; b < strains.size(); ++b) {
        const double e = strains[b];
        if (e == never) continue;
        const auto material = [&](int i) -> const Material& {
            return model.materials[model.particles.material[i]];
        };
        const bool tension_only =
            material(model.bonds.first[b]).tension_only && material(model.bonds.second[b]).tension_only;
        limits.upper[b] = e * (2 + e);
        if (!tension_only && e < 1) limits.lower[b] = e * (e - 2);
    }
    return limits;
}

template std::vector<double> break_strains<2>(const Model<2>&, const Physics&);
template BreakLimits break_limits<2>(const Model<2>&, const std::vector<double>&);

}  // namespace hibi
