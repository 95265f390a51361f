#pragma once
#include <array>
#include <vector>

#include "image/axis.hpp"
#include "image/canvas.hpp"
#include "image/overlay.hpp"
#include "image/text.hpp"

namespace hibi {

/// The load-displacement curve (and the count of broken bonds over the same displacement), growing with the
/// film.
class Inset {
 public:
    /// `text` is the size of ordinary text, `unit` scales the lines.
    Inset(const InsetCurve& curve, const PixelRect& rect, const Theme& theme, const Typesetter& type,
          double text, double unit);

    void draw_axes(cairo_t* cairo) const;
    /// The lines up to `time`, and a dot at the last point.
    void draw_lines(cairo_t* cairo, double time) const;

 private:
    struct Line {
        std::vector<double> time;
        std::vector<std::array<double, 2>> points;  // pixels; those that nobody could tell apart are left out
        void add(double t, double x, double y, bool last);
        void draw(cairo_t* cairo, double time, double dot) const;
    };
    const Theme& theme_;
    const Typesetter& type_;
    double text_, unit_;
    PixelRect rect_, axes_;
    std::string x_title_, y_title_, broken_max_;
    double x_low_, x_high_, y_low_, y_high_;  // written numbers
    Ticks x_ticks_, y_ticks_;
    Line line_, broken_;
    std::vector<Line> others_;
};

}  // namespace hibi
