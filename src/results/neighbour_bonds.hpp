#pragma once
#include "results/snapshot.hpp"

namespace hibi {

/// Length up to which a bond joins neighbours (spacings): the side of a cell; where a lattice is jittered, seen by
/// a bond shorter than a spacing, most of the disturbed sides and diagonals, or the body would be drawn with
/// holes.
inline double longest_neighbour_bond(const Topology& topology) {
    for (std::size_t b = 0; b < topology.rest_length.size(); ++b)
        if (topology.rest_length[b] < 0.99 * topology.spacing[topology.first[b]]) return 1.6;
    return 1.2;
}

}  // namespace hibi
