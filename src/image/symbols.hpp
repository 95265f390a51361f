#pragma once
#include "image/canvas.hpp"
#include "image/overlay.hpp"

namespace hibi {

/// Full length of a load arrow and depth of the other symbols, for a picture unit of 1 (pixels).
inline constexpr double arrow_length = 64, hatch_depth = 13, roller_radius = 6.5;

/// Draws one support or load. `unit` scales lines and lengths with the picture (Layout::unit).
void draw_symbol(cairo_t* cairo, const Symbol& symbol, const Theme& theme, double unit);

}  // namespace hibi
