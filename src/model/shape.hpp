#pragma once
#include <variant>
#include <vector>

#include "base/vec.hpp"
#include "model/polygon.hpp"
#include "model/span.hpp"

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

/// A point nearer to a side than this part of the spacing lies on it: rounding must not decide on which side
/// a particle falls. All shapes, selections, notches and bonds go by it.
inline constexpr double slack_per_spacing = 1e-6;

/// The sides belong to the shape: a point outside of it by no more than `slack` (m) is inside; where the
/// slack is negative, it must be inside by that much. What a difference takes away takes its sides along, so
/// that a body fits into the hole that was cut for it.
template <int Dim>
bool inside(const Shape<Dim>& shape, const Vec<Dim>& X, double slack = 0);
/// Distance to the nearest side, negative outside (m). Of a difference it may be too small, never too large.
template <int Dim>
double depth(const Shape<Dim>& shape, const Vec<Dim>& X);
template <int Dim>
Box<Dim> bounding_box(const Shape<Dim>& shape);
/// The straight way between any two of its points lies in it.
template <int Dim>
bool is_convex(const Shape<Dim>& shape);
/// The parts of the segment from `p` to `q` that are inside the shape by the same slack.
template <int Dim>
Spans spans(const Shape<Dim>& shape, const Vec<Dim>& p, const Vec<Dim>& q, double slack = 0);

template <int Dim>
struct Content {
    double measure = 0;                    ///< area (2-D, m^2) or volume (3-D, m^3)
    Vec<Dim> centroid = Vec<Dim>::Zero();  ///< (m)
};
/// Exact but for rounding; of a difference to about a millionth of the size of its first shape.
template <int Dim>
Content<Dim> content(const Shape<Dim>& shape);

}  // namespace hibi
