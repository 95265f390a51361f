#pragma once
#include <memory>
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

/// Centres of the lattice cells of size `spacing` that lie inside the shape, row by row (x fastest), each row of
/// a box beginning half a spacing inside. Discs and rings are filled symmetrically about their centre, polygons
/// from the low corner of their bounding box, a difference like its first shape.
template <int Dim>
std::vector<Vec<Dim>> fill(const Shape<Dim>& shape, double spacing);

}  // namespace hibi
