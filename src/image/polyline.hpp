#pragma once
#include <array>
#include <optional>
#include <vector>

#include "image/camera.hpp"

namespace hibi {

using Point = std::array<double, 2>;
using Polyline = std::vector<Point>;

/// The part of a straight line inside the rectangle, if any.
std::optional<std::array<Point, 2>> cut(const Point& from, const Point& to, const PixelRect& rect);

/// The parts of a line inside the rectangle, in order. A point alone is a part of its own.
std::vector<Polyline> cut(const Polyline& line, const PixelRect& rect);

/// A line that nobody can tell from this one, with fewer points: no point left out is further than
/// `tolerance` from it, but for what goes up and down within four times that; of it the ends are kept.
Polyline simplified(const Polyline& line, double tolerance);

}  // namespace hibi
