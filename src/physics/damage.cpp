#include "physics/damage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/hash.hpp"
#include "physics/mixed_bonds.hpp"

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
    std::vector<std::array<bool, 3>> held(particles.count(), std::array<bool, 3>{});
    std::vector<char> gripped(particles.count(), 0);
    for (const Hold& hold : physics.holds)
        for (const int i : hold.particles)
            for (int a = 0; a < Dim; ++a) held[i][a] = held[i][a] || hold.axes[a];
    for (const Load& load : physics.loads)
        if (load.no_fail)
            for (const int i : load.particles) gripped[i] = 1;
    const auto safe = [&](int i) {
        return std::all_of(held[i].begin(), held[i].begin() + Dim, [](bool h) { return h; });
    };

    const auto limit = [&](const Material& m, double l0, double length) {
        if (m.break_strain) return *m.break_strain;
        if (m.fracture_energy) return fracture_strain(m, model.assumption, model.influence, l0, length);
        return never;
    };
    const Bonds& bonds = model.bonds;
    const std::vector<MixedBond> all_mixed = mixed_bonds(model);
    auto mixed = all_mixed.begin();
    std::vector<double> strains(bonds.count(), never);
    for (int b = 0; b < bonds.count(); ++b) {
        const int i = bonds.first[b], j = bonds.second[b];
        while (mixed != all_mixed.end() && mixed->bond < b) ++mixed;
        if ((safe(i) && safe(j)) || (gripped[i] && gripped[j])) continue;
        const double l0 = particles.spacing[i], length = bonds.rest_length[b];  // bonded bodies share l0
        const Material* weaker = nullptr;
        const auto consider = [&](int k, double modulus) {
            const Material& m = model.materials[k];
            const double share = shear_modulus(m) / modulus;  // of the bond's strain over the material's
            const double strain = limit(m, l0, length) * (m.break_strain ? share : std::sqrt(share));
            if (weaker && !(strain < strains[b])) return;
            weaker = &m;
            strains[b] = strain;
        };
        if (mixed != all_mixed.end() && mixed->bond == b) {
            for (const int k : mixed->materials) consider(k, mixed->modulus);
        } else {
            for (const int end : {i, j})
                consider(particles.material[end], shear_modulus(model.materials[particles.material[end]]));
        }
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
