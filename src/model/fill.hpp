#pragma once
#include <cstdint>
#include <vector>

#include "model/shape.hpp"

namespace hibi {

/// How the particles of a body are arranged: square cells, turned, then disturbed.
struct Lattice {
    double angle = 0;  ///< from the x axis to the rows, counter-clockwise (rad)
    double jitter =
        0;  ///< each particle is moved by up to this many spacings, either way, along x and along y
    std::uint64_t seed = 1;  ///< of the jitter

    bool is_turned() const { return angle != 0; }
    bool operator==(const Lattice&) const = default;
};

/// Centres of the lattice cells of size `spacing` that lie inside the shape, row by row, each row of a box
/// beginning half a spacing inside. A centre on a side is inside: to leave it out would miss as much of the
/// area as to take it adds, half a cell, and so all centres on all sides are treated alike. Discs and rings
/// are filled symmetrically about their centre, polygons from the low corner of their bounding box, a
/// difference like its first shape. A turned lattice is turned about the corner of a cell next to the middle
/// of the bounding box. Jitter is added afterwards, keyed by the cell: it depends on no order, and moves
/// nothing into the body or out of it.
template <int Dim>
std::vector<Vec<Dim>> fill(const Shape<Dim>& shape, double spacing, const Lattice& lattice = {});

}  // namespace hibi
