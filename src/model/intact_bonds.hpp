#pragma once
#include <algorithm>
#include <numeric>
#include <vector>

#include "model/state.hpp"

namespace hibi {

// All walks along the bonds that are intact.

/// Calls visit(j, bond) for each intact bond of particle i, which leads to j, in rising order of the bond.
template <int Dim, class Visit>
void each_intact_bond(const Bonds& bonds, const State<Dim>& state, int i, Visit&& visit) {
    for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
        const int b = bonds.bonds_of[k];
        if (state.is_intact(b)) visit(bonds.other(b, i), b);
    }
}

/// What walk_along_intact_bonds notes of particles that it did not reach, and of those where it began.
inline constexpr int not_reached = -2, walk_begins = -1;

/// Breadth first from the particles `from`: calls visit(i) for each particle that it reaches, and stops where
/// that is false. Returns for every particle the bond by which it was reached, or one of the two above.
template <int Dim, class Visit>
std::vector<int> walk_along_intact_bonds(const Bonds& bonds, const State<Dim>& state,
                                         const std::vector<int>& from, Visit&& visit) {
    std::vector<int> came_by(bonds.start.size() - 1, not_reached), queue;
    const auto reach = [&](int i, int by) {
        if (came_by[i] != not_reached) return;
        came_by[i] = by;
        queue.push_back(i);
    };
    for (const int i : from) reach(i, walk_begins);
    for (std::size_t head = 0; head < queue.size() && visit(queue[head]); ++head)
        each_intact_bond(bonds, state, queue[head], reach);
    return came_by;
}

/// For each particle the lowest one that bonds join it to; `joins(bond)` says which bonds count.
template <class Joins>
std::vector<int> connected_parts(const Bonds& bonds, Joins&& joins) {
    std::vector<int> part(bonds.start.size() - 1);
    std::iota(part.begin(), part.end(), 0);
    const auto root = [&](int i) {
        while (part[i] != i) i = part[i] = part[part[i]];
        return i;
    };
    for (int b = 0; b < bonds.count(); ++b) {
        if (!joins(b)) continue;
        const int i = root(bonds.first[b]), j = root(bonds.second[b]);
        part[std::max(i, j)] = std::min(i, j);
    }
    for (std::size_t i = 0; i < part.size(); ++i) part[i] = root(static_cast<int>(i));
    return part;
}

}  // namespace hibi
