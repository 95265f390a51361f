#pragma once
#include <vector>

#include "base/vec.hpp"
#include "model/span.hpp"

/// Geometry of polygons. It is plane by nature.
namespace hibi {

/// A closed polygon whose sides do not cross, either way round; the last corner joins the first. Sides may
/// touch: two sides that lie on each other are a slit without width.
struct Polygon {
    std::vector<Vec<2>> corners;
};

double area(const Polygon& polygon);  ///< (m^2)
Vec<2> centroid(const Polygon& polygon);
bool is_convex(const Polygon& polygon);
/// Distance to the nearest side, negative outside (m).
double depth(const Polygon& polygon, const Vec<2>& X);
/// The parts of the segment from `p` to `q` within the polygon. A point nearer than `slack` to a side lies on
/// it; such a point is inside where the slack is positive, and outside where it is negative.
Spans spans(const Polygon& polygon, const Vec<2>& p, const Vec<2>& q, double slack);

}  // namespace hibi
