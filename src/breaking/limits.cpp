#include "breaking/limits.hpp"

#include <cmath>
#include <limits>

#include "base/hash.hpp"
#include "loads/supports.hpp"

namespace hibi {

namespace {
constexpr double never = std::numeric_limits<double>::infinity();
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
        if (m.fracture_energy) return fracture_strain<Dim>(model, m, l0, length);
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
