#pragma once
#include <limits>
#include <vector>

#include "model/model.hpp"
#include "elasticity/elastic_law.hpp"
#include "elasticity/weights.hpp"

namespace hibi {

/// The bonds seen from every particle, each bond twice: the form that loops over particles walk. A loop over
/// it writes only to its own particle, so it gives the same bits on any number of threads. Slots of particle
/// i: start[i] .. start[i+1], in the order of Bonds::bonds_of.
template <int Dim>
struct BondList {
    std::vector<int> start, neighbour, bond;
    std::vector<Vec<Dim>> r0;          ///< X_neighbour - X_i (m)
    std::vector<double> own, other;    ///< s_ij / |r0|^2 and s_ji / |r0|^2 (m); 0 once broken
    std::vector<double> upper, lower;  ///< limits times |r0|^2 (m^2); empty: nothing is watched

    BondList(const Model<Dim>& model, const BondWeights& s) {
        const Bonds& bonds = model.bonds;
        start = bonds.start;
        bond = bonds.bonds_of;
        const int slots = static_cast<int>(bond.size());
        neighbour.resize(slots);
        r0.resize(slots);
        own.resize(slots);
        other.resize(slots);
        for (int i = 0; i < model.particles.count(); ++i) {
            for (int k = start[i]; k < start[i + 1]; ++k) {
                const int b = bond[k];
                const bool forward = bonds.first[b] == i;
                neighbour[k] = bonds.other(b, i);
                r0[k] = (forward ? 1 : -1) * model.bond_vectors[b];
                const double square = r0[k].squaredNorm();
                own[k] = (forward ? s.forward[b] : s.backward[b]) / square;
                other[k] = (forward ? s.backward[b] : s.forward[b]) / square;
            }
        }
    }

    /// Infinite limits are never passed; a broken bond (own = 0) is not watched either.
    void watch(const BreakLimits& limits) {
        constexpr double never = std::numeric_limits<double>::infinity();
        upper.resize(bond.size());
        lower.resize(bond.size());
        for (std::size_t k = 0; k < bond.size(); ++k) {
            upper[k] = own[k] == 0 ? never : limits.upper[bond[k]] * r0[k].squaredNorm();
            lower[k] = own[k] == 0 ? -never : limits.lower[bond[k]] * r0[k].squaredNorm();
        }
    }

    bool is_beyond_limits(const std::vector<Vec<Dim>>& displacement, int i) const {
        bool beyond = false;
        for (int k = start[i]; k < start[i + 1]; ++k) {
            const Vec<Dim> du = displacement[neighbour[k]] - displacement[i];
            const double growth = 2 * r0[k].dot(du) + du.squaredNorm();  // L^2 - L0^2
            beyond |= growth > upper[k] || growth < lower[k];
        }
        return beyond;
    }

    void remove(const Bonds& bonds, int broken) {
        for (const int i : {bonds.first[broken], bonds.second[broken]}) {
            for (int k = start[i]; k < start[i + 1]; ++k) {
                if (bond[k] != broken) continue;
                own[k] = other[k] = 0;
                if (upper.empty()) continue;
                upper[k] = std::numeric_limits<double>::infinity();
                lower[k] = -upper[k];
            }
        }
    }
};

}  // namespace hibi
