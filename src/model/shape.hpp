#pragma once
#include <cstdint>
#include <variant>
#include <vector>

#include "base/vec.hpp"

namespace hibi {

/// Axis-parallel box from `low` to `high` (m).
template <int Dim>
struct Box {
    Vec<Dim> low, high;
};
template <int Dim>
struct Disc {
    Vec<Dim> centre;
    double radius = 0;  ///< (m)
};
template <int Dim>
struct Ring {
    Vec<Dim> centre;
    double inner = 0, outer = 0;  ///< radii (m)
};
/// A simple closed polygon, either way round; the last corner joins the first.
struct Polygon {
    std::vector<Vec<2>> corners;
};
template <int Dim>
struct Shape;
/// The first shape less all the others.
template <int Dim>
struct Difference {
    std::vector<Shape<Dim>> parts;
};
template <int Dim>
struct Shape {
    std::variant<Box<Dim>, Disc<Dim>, Ring<Dim>, Polygon, Difference<Dim>> form;
};

template <int Dim>
bool inside(const Shape<Dim>& shape, const Vec<Dim>& X);
template <int Dim>
Box<Dim> bounding_box(const Shape<Dim>& shape);
/// Area (2-D, m^2) or volume (3-D, m^3); of a Difference to about 0.1 %.
template <int Dim>
double measure(const Shape<Dim>& shape);

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
/// beginning half a spacing inside. Discs and rings are filled symmetrically about their centre, polygons
/// from the low corner of their bounding box, a difference like its first shape. A turned lattice is turned
/// about the corner of a cell next to the middle of the bounding box. Jitter is added afterwards, keyed by
/// the cell: it depends on no order, and moves nothing into the body or out of it.
template <int Dim>
std::vector<Vec<Dim>> fill(const Shape<Dim>& shape, double spacing, const Lattice& lattice = {});

}  // namespace hibi
