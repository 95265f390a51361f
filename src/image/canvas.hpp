#pragma once
#include <cairo.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>

#include "image/camera.hpp"
#include "image/image.hpp"
#include "image/theme.hpp"

namespace hibi {

struct CairoRelease {
    void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
    void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
using CairoSurface = std::unique_ptr<cairo_surface_t, CairoRelease>;
using CairoPen = std::unique_ptr<cairo_t, CairoRelease>;

/// Draws straight on the image's memory, which has to outlive it.
inline CairoSurface surface_on(Image& image) {
    return CairoSurface(cairo_image_surface_create_for_data(image.bgra.data(), CAIRO_FORMAT_RGB24,
                                                            image.width, image.height, image.stride()));
}

inline CairoPen pen_on(const CairoSurface& surface) {
    CairoPen pen(cairo_create(surface.get()));
    if (const cairo_status_t status = cairo_status(pen.get()); status != CAIRO_STATUS_SUCCESS)
        throw std::runtime_error(std::string("Cairo cannot draw: ") + cairo_status_to_string(status));
    return pen;
}

inline void set_colour(cairo_t* cairo, const Rgb& colour, double alpha = 1) {
    cairo_set_source_rgba(cairo, colour[0], colour[1], colour[2], alpha);
}

/// A straight stroke between two points.
inline void stroke_line(cairo_t* cairo, double x0, double y0, double x1, double y1) {
    cairo_move_to(cairo, x0, y0);
    cairo_line_to(cairo, x1, y1);
    cairo_stroke(cairo);
}

/// A rectangle with round corners, as path.
inline void round_rect(cairo_t* cairo, const PixelRect& r, double radius) {
    constexpr double quarter = 1.57079632679489661923;
    cairo_new_sub_path(cairo);
    cairo_arc(cairo, r.x + r.width - radius, r.y + radius, radius, -quarter, 0);
    cairo_arc(cairo, r.x + r.width - radius, r.y + r.height - radius, radius, 0, quarter);
    cairo_arc(cairo, r.x + radius, r.y + r.height - radius, radius, quarter, 2 * quarter);
    cairo_arc(cairo, r.x + radius, r.y + radius, radius, 2 * quarter, 3 * quarter);
    cairo_close_path(cairo);
}

/// The middle of the pixel that the coordinate falls into: lines one pixel wide stay sharp there.
inline double crisp(double at) { return static_cast<double>(static_cast<long>(at)) + 0.5; }

}  // namespace hibi
