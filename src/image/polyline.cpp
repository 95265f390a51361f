#include "image/polyline.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace hibi {

std::optional<std::array<Point, 2>> cut(const Point& from, const Point& to, const PixelRect& rect) {
    // Liang and Barsky: the share of the line that lies between both pairs of edges.
    const double low[] = {rect.x, rect.y}, high[] = {rect.x + rect.width, rect.y + rect.height};
    double first = 0, last = 1;
    for (int c = 0; c < 2; ++c) {
        const double step = to[c] - from[c];
        if (step == 0) {
            if (from[c] < low[c] || from[c] > high[c]) return {};
            continue;
        }
        double enters = (low[c] - from[c]) / step, leaves = (high[c] - from[c]) / step;
        if (enters > leaves) std::swap(enters, leaves);
        first = std::max(first, enters);
        last = std::min(last, leaves);
    }
    if (first > last) return {};
    const auto at = [&](double share) {
        return Point{from[0] + share * (to[0] - from[0]), from[1] + share * (to[1] - from[1])};
    };
    return std::array{first > 0 ? at(first) : from, last < 1 ? at(last) : to};
}

std::vector<Polyline> cut(const Polyline& line, const PixelRect& rect) {
    std::vector<Polyline> parts;
    if (line.size() == 1 && cut(line[0], line[0], rect)) parts.push_back(line);
    bool inside = false;  // does the last part end where the next step begins?
    for (std::size_t k = 1; k < line.size(); ++k) {
        const auto step = cut(line[k - 1], line[k], rect);
        if (step) {
            if (!inside) parts.push_back({(*step)[0]});
            parts.back().push_back((*step)[1]);
        }
        inside = step && (*step)[1] == line[k];
    }
    return parts;
}

namespace {

/// Of the points that follow each other in one column, the first, lowest, highest and last, in order.
Polyline thinned(const Polyline& line, double column) {
    Polyline kept;
    for (std::size_t begin = 0, end = 0; begin < line.size(); begin = end) {
        const double place = std::floor(line[begin][0] / column);
        while (end < line.size() && std::floor(line[end][0] / column) == place) ++end;
        const auto [low, high] =
            std::minmax_element(line.begin() + static_cast<std::ptrdiff_t>(begin),
                                line.begin() + static_cast<std::ptrdiff_t>(end),
                                [](const Point& a, const Point& b) { return a[1] < b[1]; });
        std::array<std::size_t, 4> wanted{begin, static_cast<std::size_t>(low - line.begin()),
                                          static_cast<std::size_t>(high - line.begin()), end - 1};
        std::ranges::sort(wanted);
        for (int k = 0; k < 4; ++k)
            if (k == 0 || wanted[k] != wanted[k - 1]) kept.push_back(line[wanted[k]]);
    }
    return kept;
}

double distance(const Point& p, const Point& a, const Point& b) {
    const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
    const double share =
        length2 > 0 ? std::clamp(((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0;
    return std::hypot(p[0] - a[0] - share * dx, p[1] - a[1] - share * dy);
}

}  // namespace

Polyline simplified(const Polyline& line, double tolerance) {
    const Polyline points = thinned(line, 4 * tolerance);
    if (points.size() < 3) return points;
    // Douglas and Peucker: the point furthest from the chord is kept, and both sides are looked at again.
    std::vector<char> keep(points.size(), 0);
    keep.front() = keep.back() = 1;
    std::vector<std::array<std::size_t, 2>> open{{0, points.size() - 1}};
    while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        double most = tolerance;
        std::size_t furthest = a;
        for (std::size_t k = a + 1; k < b; ++k)
            if (const double d = distance(points[k], points[a], points[b]); d > most) most = d, furthest = k;
        if (furthest == a) continue;
        keep[furthest] = 1;
        open.push_back({a, furthest});
        open.push_back({furthest, b});
    }
    Polyline kept;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (keep[k]) kept.push_back(points[k]);
    return kept;
}

}  // namespace hibi
