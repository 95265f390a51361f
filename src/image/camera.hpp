#pragma once
#include <algorithm>

#include "base/vec.hpp"

namespace hibi {

/// A rectangle of the picture, in pixels, y downward.
struct PixelRect {
    double x = 0, y = 0, width = 0, height = 0;
};

/// Maps a 2-D world window into a pixel rectangle, same scale both ways, centred. World y is up, pixel y
/// down.
struct Camera2 {
    double scale = 1;                   ///< pixels per metre
    double centre_x = 0, centre_y = 0;  ///< world point (m) shown at the middle of the rectangle
    PixelRect rect;

    static Camera2 fit(double x0, double y0, double x1, double y1, const PixelRect& rect) {
        return {std::min(rect.width / (x1 - x0), rect.height / (y1 - y0)), (x0 + x1) / 2, (y0 + y1) / 2,
                rect};
    }
    double pixel_x(double x) const { return rect.x + rect.width / 2 + (x - centre_x) * scale; }
    double pixel_y(double y) const { return rect.y + rect.height / 2 - (y - centre_y) * scale; }
};

}  // namespace hibi
