#include "physics/damage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/hash.hpp"

namespace hibi {

namespace {
constexpr double never = std::numeric_limits<double>::infinity();
}

double fracture_strain(double Gc, double E, double l0) { return 0.71 * std::sqrt(Gc / (E * l0)); }

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

    const auto limit = [&](const Material& m, double l0) {
        if (m.break_strain) return *m.break_strain;
        if (m.fracture_energy) return fracture_strain(*m.fracture_energy, m.youngs_modulus, l0);
        return never;
    };
    const Bonds& bonds = model.bonds;
    std::vector<double> strains(bonds.count(), never);
    for (int b = 0; b < bonds.count(); ++b) {
        const int i = bonds.first[b], j = bonds.second[b];
        if ((safe(i) && safe(j)) || (gripped[i] && gripped[j])) continue;
        const Material* weaker = &model.materials[particles.material[i]];
        const Material* other = &model.materials[particles.material[j]];
        if (limit(*other, particles.spacing[j]) < limit(*weaker, particles.spacing[i])) weaker = other;
        strains[b] = limit(*weaker, particles.spacing[i]);
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
