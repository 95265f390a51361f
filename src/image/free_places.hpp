#pragma once
#include <optional>
#include <vector>

#include "image/polyline.hpp"

namespace hibi {

/// Room for labels in an area that lines and other labels share.
class FreePlaces {
 public:
    /// Labels keep the distance `clear` from everything, the area's edges included.
    FreePlaces(const PixelRect& area, double clear) : area_(area), clear_(clear) {}

    void take(const Polyline& line);
    void take(const PixelRect& box) { boxes_.push_back(box); }

    /// The free place for a label of that size which is nearest to a point, but not nearer than `gap`; the
    /// straight way to it passes no other label and, if that can be, no line. Of equals the one at the right,
    /// and higher up.
    std::optional<PixelRect> nearest(const Point& to, double width, double height, double gap) const;

 private:
    bool is_free(const PixelRect& box) const;
    bool crosses_line(const Point& from, const Point& to) const;
    bool crosses_box(const Point& from, const Point& to) const;

    PixelRect area_;
    double clear_;
    std::vector<std::array<Point, 2>> lines_;
    std::vector<PixelRect> boxes_;
};

/// Of a box, the point nearest to this one.
Point nearest_point(const PixelRect& box, const Point& to);

}  // namespace hibi
