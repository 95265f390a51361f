#pragma once
#include <cmath>
#include <string>

namespace hibi {

/// How a single figure is made for print: sizes are those on paper.
struct FigureStyle {
    std::string theme = "light";
    double width_mm = 170;
    double dpi = 300;
    double text_pt = 8;  ///< ordinary text

    int width() const { return static_cast<int>(std::lround(width_mm / 25.4 * dpi)); }  ///< (pixels)
    double points(double pt) const { return pt / 72 * dpi; }                            ///< in pixels
    double text() const { return points(text_pt); }                                     ///< (pixels)
    double margin() const { return mm(1.5); }  ///< at every side (pixels)
    double mm(double length) const { return length / 25.4 * dpi; }                      ///< in pixels
};

}  // namespace hibi
