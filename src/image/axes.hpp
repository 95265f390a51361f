#pragma once
#include <string>
#include <vector>

#include "image/ink.hpp"

namespace hibi {

struct Tick {
    double at = 0;       ///< along its axis, in the pen's lengths
    std::string text{};  ///< empty: a small one without a number
};

/// How the axes of a diagram look.
struct AxesStyle {
    const Theme& theme;
    double text = 12;   ///< size of ordinary text; numbers are a little smaller
    double line = 1;    ///< width
    bool crisp = true;  ///< lines in the middle of pixels
};
TextStyle number_style(const AxesStyle& style);
/// Baseline of the lower numbers below the rectangle of the axes, in sizes of ordinary text.
inline constexpr double numbers_below = 1.35;

/// Left and lower axis, numbers with grid lines at the left, numbers with ticks below.
void draw_axes(Ink& ink, const PixelRect& axes, const std::vector<Tick>& x, const std::vector<Tick>& y,
               const AxesStyle& style);

}  // namespace hibi
