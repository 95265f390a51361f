#include "model/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hibi {

namespace {

double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Twice the area, positive counter-clockwise (m^2), and the same times the centroid, both as seen from the
/// first corner: far from the origin nothing is lost.
struct Sums {
    double area = 0;
    Vec<2> moment = Vec<2>::Zero();
};
Sums sums(const std::vector<Vec<2>>& corners) {
    Sums sums;
    for (std::size_t k = 2; k < corners.size(); ++k) {
        const Vec<2> a = corners[k - 1] - corners[0], b = corners[k] - corners[0];
        const double twice = cross(a, b);
        sums.area += twice;
        sums.moment += twice * (a + b) / 3;
    }
    return sums;
}

/// Where the outline passes from one side of a segment's line to the other.
struct Crossing {
    double at = 0;         ///< from the first point of the segment (m)
    double sine = 1;       ///< of the angle between the segment and the outline
    bool leaving = false;  ///< the segment leaves the polygon here
};

/// Does the crossing lie on the segment? Where the sides belong to the polygon (the slack is not negative), a
/// segment that ends on a side crosses it only if it comes from outside or goes there; else, if it comes from
/// inside or goes there. Moves `at` to the end it belongs to.
bool is_on(Crossing& crossing, double length, double slack) {
    const double behind = crossing.at * crossing.sine, ahead = (length - crossing.at) * crossing.sine;
    const bool at_first = std::abs(behind) <= std::abs(slack), at_last = std::abs(ahead) <= std::abs(slack);
    if (at_first && at_last) return false;  // it runs along the side
    if (!at_first && !at_last) return crossing.at > 0 && crossing.at < length;
    crossing.at = at_first ? 0 : length;
    return (crossing.leaving == at_first) == (slack >= 0);
}

/// Corners on the line of the segment take the side of those before and behind them, so an outline that only
/// touches the line does not cross it, whatever the rounding.
std::vector<Crossing> crossings(const std::vector<Vec<2>>& corners, const Vec<2>& p, const Vec<2>& along,
                                double length, double slack) {
    const std::size_t n = corners.size();
    const auto height = [&](std::size_t k) { return cross(along, corners[k % n] - p); };
    const auto place = [&](std::size_t k) { return along.dot(corners[k % n] - p); };
    std::size_t first = 0;
    while (first < n && std::abs(height(first)) <= std::abs(slack)) ++first;
    if (first == n) return {};
    const bool counter_clockwise = sums(corners).area > 0;
    std::vector<Crossing> found;
    double before = height(first);
    std::size_t last_off = first;
    for (std::size_t k = first + 1; k <= first + n; ++k) {
        const double here = height(k);
        if (std::abs(here) <= std::abs(slack)) continue;
        if ((here > 0) != (before > 0)) {
            Crossing crossing{.leaving = (before < 0) == counter_clockwise};
            if (last_off + 1 == k) {
                const double from = place(last_off), to = place(k);
                crossing.at = from - before * (to - from) / (here - before);
                crossing.sine = std::abs(here - before) / (corners[k % n] - corners[last_off % n]).norm();
            } else {  // a side may lie on the segment: it belongs to the polygon
                crossing.at = place(last_off + 1);
                for (std::size_t on = last_off + 2; on < k; ++on)
                    crossing.at = crossing.leaving ? std::max(crossing.at, place(on))
                                                   : std::min(crossing.at, place(on));
            }
            if (is_on(crossing, length, slack)) found.push_back(crossing);
        }
        before = here;
        last_off = k;
    }
    std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) { return a.at < b.at; });
    return found;
}

}  // namespace

double area(const Polygon& polygon) { return std::abs(sums(polygon.corners).area) / 2; }

Vec<2> centroid(const Polygon& polygon) {
    const Sums sum = sums(polygon.corners);
    return polygon.corners.front() + (sum.area != 0 ? Vec<2>(sum.moment / sum.area) : Vec<2>::Zero());
}

bool is_convex(const Polygon& polygon) {
    // All corners turn the same way, and once round.
    const auto& corners = polygon.corners;
    const std::size_t n = corners.size();
    const double way = sums(corners).area > 0 ? 1 : -1;
    double turned = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec<2> in = corners[(k + 1) % n] - corners[k];
        const Vec<2> out = corners[(k + 2) % n] - corners[(k + 1) % n];
        const double turn = way * std::atan2(cross(in, out), in.dot(out));
        if (turn < 0) return false;
        turned += turn;
    }
    return turned < 7;  // 2 pi, not 4 pi
}

double depth(const Polygon& polygon, const Vec<2>& X) {
    const auto& corners = polygon.corners;
    double nearest = std::numeric_limits<double>::infinity();
    bool odd = false;
    for (std::size_t k = 0, last = corners.size() - 1; k < corners.size(); last = k++) {
        const Vec<2>&a = corners[last], &b = corners[k];
        if ((a.y() > X.y()) != (b.y() > X.y()) &&
            X.x() < (b.x() - a.x()) * (X.y() - a.y()) / (b.y() - a.y()) + a.x())
            odd = !odd;
        const Vec<2> side = b - a, to = X - a;
        const double length = side.squaredNorm();
        const double t = length > 0 ? std::clamp(to.dot(side) / length, 0.0, 1.0) : 0.0;
        nearest = std::min(nearest, (to - t * side).squaredNorm());
    }
    return odd ? std::sqrt(nearest) : -std::sqrt(nearest);
}

Spans spans(const Polygon& polygon, const Vec<2>& p, const Vec<2>& q, double slack) {
    const double length = (q - p).norm();
    int layers = depth(polygon, p) >= -slack ? 1 : 0;
    double open = 0;
    Spans result;
    for (const Crossing& crossing : crossings(polygon.corners, p, (q - p) / length, length, slack)) {
        const double at = crossing.at / length;
        // On a slit without width the segment may enter the one side before it leaves the other.
        if (layers == 1) result.push_back({open, at});
        open = at;
        layers = std::max(0, layers + (crossing.leaving ? -1 : 1));
    }
    if (layers > 0) result.push_back({open, 1});
    return result;
}

}  // namespace hibi
