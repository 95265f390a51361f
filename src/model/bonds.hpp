#pragma once
#include <limits>
#include <vector>

#include "base/vec.hpp"

namespace hibi {

/// One entry per bond. A bond is stored once, so it breaks once, and can be drawn and counted.
/// Sorted by (first, second), first < second. When a bond broke stands in State::broken_at.
struct Bonds {
    /// The time at which a bond broke that has not broken.
    static constexpr double intact = std::numeric_limits<double>::infinity();

    std::vector<int> first, second;    ///< particle indices
    std::vector<double> rest_length;   ///< |X_second - X_first| (m)
    std::vector<int> start, bonds_of;  ///< bonds of particle i: bonds_of[start[i] .. start[i+1])

    int count() const { return static_cast<int>(first.size()); }
    int other(int bond, int particle) const { return first[bond] == particle ? second[bond] : first[bond]; }
};

/// r0 = X_second - X_first of all bonds. Equal bonds of a lattice, which differ only by rounding, share one
/// entry: particles alike then have the same bits everywhere, and the fast loops one small table.
template <int Dim>
struct BondVectors {
    std::vector<int> kind;        ///< per bond, its place in the table
    std::vector<Vec<Dim>> table;  ///< r0 (m)

    const Vec<Dim>& operator[](int bond) const { return table[kind[bond]]; }
};

/// Fills start and bonds_of from first and second; the bonds of a particle come in rising order of the bond.
void index_bonds(Bonds& bonds, int particles);

}  // namespace hibi
