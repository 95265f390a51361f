#include "elasticity/weights.hpp"

#include <cmath>

#include "base/parallel.hpp"
#include "elasticity/mixed_bonds.hpp"
#include "elasticity/moment_factors.hpp"

namespace hibi {

double weight(double r, double re) { return r < re ? re / r - 1 : 0; }

template <int Dim>
double reference_number_density(double ratio) {
    const int reach = static_cast<int>(std::ceil(ratio)), depth = Dim == 3 ? reach : 0;
    double sum = 0;
    for (int z = -depth; z <= depth; ++z)
        for (int y = -reach; y <= reach; ++y)
            for (int x = -reach; x <= reach; ++x)
                if (x != 0 || y != 0 || z != 0)
                    sum += weight(z == 0 ? std::hypot(x, y) : std::hypot(x, y, z), ratio);
    return sum;
}

template <int Dim>
BondWeights moment_matched_weights(const Model<Dim>& model) {
    const Particles<Dim>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    BondWeights s{std::vector<double>(bonds.count()), std::vector<double>(bonds.count())};
    // Particles deep inside a lattice are all alike: the weights of the last one mostly do for the next.
    struct Neighbourhood {
        std::vector<int> kinds;  ///< of the bonds, negative where they are seen from their second end
        double spacing = 0;
        bool operator==(const Neighbourhood&) const = default;
    };
    parallel_for(particles.count(), [&](int begin, int end) {
        Neighbourhood last, here;
        std::vector<Vec<Dim>> normals;
        std::vector<double> share, weights;  // d w / n; s_ij / V
        for (int i = begin; i < end; ++i) {
            here.kinds.clear();
            here.spacing = particles.spacing[i];
            for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
                const int b = bonds.bonds_of[k], kind = model.bond_vectors.kind[b];
                here.kinds.push_back(bonds.first[b] == i ? kind : ~kind);
            }
            if (i == begin || !(here == last)) {
                normals.clear();
                share.clear();
                double density = 0;
                for (const int kind : here.kinds) {
                    const Vec<Dim> r0 = model.bond_vectors.table[kind < 0 ? ~kind : kind];
                    const double length = r0.norm();
                    normals.push_back((kind < 0 ? -1 : 1) / length * r0);
                    share.push_back(weight(length, model.influence * here.spacing));
                    density += share.back();
                }
                for (double& w : share) w *= Dim / density;
                weights = moment_factors<Dim>(normals, share, identity<Dim>());
                for (std::size_t k = 0; k < share.size(); ++k) weights[k] *= share[k];
                std::swap(last, here);
            }
            for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
                const int b = bonds.bonds_of[k];
                auto& mine = bonds.first[b] == i ? s.forward : s.backward;
                mine[b] = particles.volume[i] * weights[k - bonds.start[i]];
            }
        }
    });
    return s;
}

template <int Dim>
BondWeights thesis_weights(const Model<Dim>& model) {
    const Particles<Dim>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    const double n0 = reference_number_density<Dim>(model.influence);
    BondWeights s{std::vector<double>(bonds.count()), std::vector<double>(bonds.count())};
    parallel_for(bonds.count(), [&](int begin, int end) {
        for (int b = begin; b < end; ++b) {
            const int i = bonds.first[b], j = bonds.second[b];
            const double w = weight(bonds.rest_length[b], model.influence * particles.spacing[i]);
            s.forward[b] = particles.volume[i] * Dim * w / n0;
            s.backward[b] = particles.volume[j] * Dim * w / n0;
        }
    });
    const auto mu = [&](int i) { return shear_modulus(model.materials[particles.material[i]]); };
    for (const MixedBond& mixed : mixed_bonds(model)) {
        const int b = mixed.bond;
        s.forward[b] *= 2 * mixed.first_length * mixed.modulus / mu(bonds.first[b]);
        s.backward[b] *= 2 * (1 - mixed.first_length) * mixed.modulus / mu(bonds.second[b]);
    }
    return s;
}

template <int Dim>
std::vector<Vec<Dim>> nodal_areas(const Model<Dim>& model) {
    const Particles<Dim>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    const BondWeights s = moment_matched_weights(model);
    std::vector<Vec<Dim>> areas(particles.count(), Vec<Dim>::Zero());
    for (int b = 0; b < bonds.count(); ++b) {
        const int i = bonds.first[b], j = bonds.second[b];
        const Vec<Dim>& r0 = model.bond_vectors[b];
        const Vec<Dim> flux = (s.forward[b] + s.backward[b]) / r0.squaredNorm() * r0;
        areas[i] -= flux;
        areas[j] += flux;
    }
    return areas;
}

template double reference_number_density<2>(double);
template BondWeights moment_matched_weights<2>(const Model<2>&);
template BondWeights thesis_weights<2>(const Model<2>&);
template std::vector<Vec<2>> nodal_areas<2>(const Model<2>&);

}  // namespace hibi
