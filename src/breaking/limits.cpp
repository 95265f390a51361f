#include "breaking/limits.hpp"

#include <cmath>
#include <limits>

#include "base/hash.hpp"
#include "elasticity/mixed_bonds.hpp"
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
