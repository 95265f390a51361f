#include "image/free_places.hpp"

#include <algorithm>
#include <cmath>

namespace hibi {

Point nearest_point(const PixelRect& box, const Point& to) {
    return {std::clamp(to[0], box.x, box.x + box.width), std::clamp(to[1], box.y, box.y + box.height)};
}

void FreePlaces::take(const Polyline& line) {
    for (std::size_t k = 1; k < line.size(); ++k) lines_.push_back({line[k - 1], line[k]});
    if (line.size() == 1) lines_.push_back({line[0], line[0]});
}

bool FreePlaces::is_free(const PixelRect& box) const {
    const PixelRect wide{box.x - clear_, box.y - clear_, box.width + 2 * clear_, box.height + 2 * clear_};
    if (wide.x < area_.x || wide.y < area_.y || wide.x + wide.width > area_.x + area_.width ||
        wide.y + wide.height > area_.y + area_.height)
        return false;
    for (const PixelRect& b : boxes_)
        if (wide.x < b.x + b.width && b.x < wide.x + wide.width && wide.y < b.y + b.height &&
            b.y < wide.y + wide.height)
            return false;
    return std::ranges::none_of(lines_,
                                [&](const auto& line) { return cut(line[0], line[1], wide).has_value(); });
}

bool FreePlaces::crosses_line(const Point& a, const Point& b) const {
    const auto side = [](const Point& p, const Point& q, const Point& r) {
        return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]) > 0;
    };
    return std::ranges::any_of(lines_, [&](const auto& line) {
        const auto& [c, d] = line;
        return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
    });
}

bool FreePlaces::crosses_box(const Point& a, const Point& b) const {
    return std::ranges::any_of(boxes_, [&](const PixelRect& box) { return cut(a, b, box).has_value(); });
}

std::optional<PixelRect> FreePlaces::nearest(const Point& to, double width, double height, double gap) const {
    struct Candidate {
        PixelRect box;
        double cost;
    };
    std::vector<Candidate> candidates;
    // Exactly beside, above and below the point, and from there on in steps.
    const double step = height / 4, middle = to[1] - height / 2;
    std::vector<double> xs{to[0] + gap, to[0] - gap - width, to[0] - width / 2};
    for (double d = step; d < area_.width; d += step) {
        xs.push_back(to[0] + gap + d);
        xs.push_back(to[0] + gap - d);
        xs.push_back(to[0] - gap - width - d);
    }
    std::vector<double> ys{middle, middle - height / 2 - gap, middle + height / 2 + gap};
    for (double d = step; d < area_.height; d += step) {
        ys.push_back(middle - d);
        ys.push_back(middle + d);
    }
    for (const double x : xs)
        for (const double y : ys) {
            const PixelRect box{x, y, width, height};
            const Point nearest = nearest_point(box, to);
            const double distance = std::hypot(nearest[0] - to[0], nearest[1] - to[1]);
            if (distance < gap * (1 - 1e-9)) continue;
            const double aside = 0.05 * std::abs(y - middle) + (y > middle ? 0.05 * step : 0);
            candidates.push_back({box, distance + aside + (x < to[0] ? 0.1 * step : 0)});
        }
    std::ranges::stable_sort(candidates, {}, &Candidate::cost);
    std::optional<PixelRect> second;
    for (const Candidate& c : candidates) {
        const Point end = nearest_point(c.box, to);
        const double length = std::hypot(end[0] - to[0], end[1] - to[1]);
        // It leaves the point, which lies on a line and inside a box of its own, at the distance of the gap.
        const Point begin{to[0] + gap / length * (end[0] - to[0]), to[1] + gap / length * (end[1] - to[1])};
        if (crosses_box(begin, end) || (second && crosses_line(begin, end)) || !is_free(c.box)) continue;
        if (second || !crosses_line(begin, end)) return c.box;
        second = c.box;
    }
    return second;
}

}  // namespace hibi
