#include "image/free_places.hpp"

#include <algorithm>
#include <cmath>

namespace hibi {

Way way_to(const PixelRect& box, const Point& from, const Point& to) {
    const double low = std::min(from[1], to[1]), high = std::max(from[1], to[1]);
    const double x = std::clamp(from[0], box.x, box.x + box.width);
    // The height that both share, or else the ends that are next to each other.
    const double y = std::clamp(std::clamp(box.y + box.height / 2, low, high), box.y, box.y + box.height);
    const Way way{{from[0], std::clamp(y, low, high)}, {x, y}, 0};
    return {way.begin, way.end, std::hypot(way.end[0] - way.begin[0], way.end[1] - way.begin[1])};
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

std::optional<PixelRect> FreePlaces::nearest(const Point& from, const Point& to, double width, double height,
                                             double gap) const {
    struct Candidate {
        PixelRect box;
        double cost;
    };
    std::vector<Candidate> candidates;
    const double step = height / 4, middle = std::min(from[1], to[1]) - height / 2;
    // Exactly beside, above and below the anchor, and from there on in steps.
    std::vector<double> xs{from[0] + gap, from[0] - gap - width, from[0] - width / 2};
    for (double d = step; d < area_.width; d += step) {
        xs.push_back(from[0] + gap + d);
        xs.push_back(from[0] + gap - d);
        xs.push_back(from[0] - gap - width - d);
    }
    std::vector<double> ys{middle, middle - height / 2 - gap, middle + height / 2 + gap};
    for (double d = step; d < area_.height; d += step) {
        ys.push_back(middle - d);
        ys.push_back(middle + d);
    }
    for (const double x : xs)
        for (const double y : ys) {
            const PixelRect box{x, y, width, height};
            const double distance = way_to(box, from, to).length;
            if (distance < gap * (1 - 1e-9)) continue;
            const double below = std::abs(y - middle) + (from == to && y > middle ? step : 0);
            candidates.push_back({box, distance + 0.05 * below + (x < from[0] ? 0.1 * step : 0)});
        }
    std::ranges::stable_sort(candidates, {}, &Candidate::cost);
    for (const Candidate& c : candidates)
        if (is_free(c.box)) return c.box;
    return {};
}

}  // namespace hibi
