#include "pictures/notch_line.hpp"

#include <algorithm>
#include <cmath>

namespace hibi {

namespace {

/// Where the sides have parted further (in spacings), the gap itself shows the notch, and a line would float
/// in it.
constexpr double widest_opening = 3;
/// Of a particle from a point of the notch beside which it lies (spacings).
constexpr double most_distance = 1.5;

/// Particles that may lie beside some point of a notch, in rising order.
std::vector<int> particles_near(const Topology& topology, const std::array<Vec3, 2>& cut) {
    const Vec3 along = cut[1] - cut[0];
    std::vector<int> near;
    for (int i = 0; i < static_cast<int>(topology.reference_position.size()); ++i) {
        const Vec3 from = topology.reference_position[i] - cut[0];
        const double at = std::clamp(from.dot(along) / along.squaredNorm(), 0.0, 1.0);
        if ((from - at * along).norm() <= (most_distance + 1e-6) * topology.spacing[i]) near.push_back(i);
    }
    return near;
}

}  // namespace

std::vector<NotchLine> find_notches(const Topology& topology) {
    std::vector<NotchLine> lines;
    if (topology.notches.empty() || topology.spacing.empty()) return lines;
    const double step = *std::ranges::min_element(topology.spacing) / 2;
    for (const std::array<Vec3, 2>& cut : topology.notches) {
        NotchLine line;
        const Vec3 along = cut[1] - cut[0], direction = along.normalized();
        const int count = std::max(1, static_cast<int>(std::ceil(along.norm() / step)));
        const std::vector<int> near = particles_near(topology, cut);
        for (int k = 0; k <= count; ++k) {
            const Vec3 point = cut[0] + along * k / count;
            std::array<int, 2> nearest{-1, -1};
            std::array<double, 2> distance{};
            for (const int i : near) {
                const Vec3 from = topology.reference_position[i] - point;
                const double far = from.norm();
                if (far > most_distance * topology.spacing[i]) continue;
                const int side = direction.x() * from.y() - direction.y() * from.x() > 0;
                if (nearest[side] >= 0 && far >= distance[side]) continue;
                nearest[side] = i;
                distance[side] = far;
            }
            if (nearest[0] < 0 || nearest[1] < 0) continue;
            line.points.push_back(point);
            line.beside.push_back(nearest);
        }
        if (line.points.size() > 1) lines.push_back(std::move(line));
    }
    return lines;
}

Symbol place_notch(const NotchLine& notch, const Topology& topology, std::span<const double> x,
                   std::span<const double> y, const Camera2& camera) {
    Symbol symbol;
    symbol.kind = Symbol::Kind::notch;
    for (std::size_t k = 0; k < notch.points.size(); ++k) {
        const auto [a, b] = notch.beside[k];
        const auto& X = topology.reference_position;
        const double apart = std::hypot(x[b] - x[a], y[b] - y[a]) - (X[b] - X[a]).norm();
        if (apart > widest_opening * topology.spacing[a]) continue;
        Vec3 p = notch.points[k];
        for (const int i : notch.beside[k]) p += (Vec3(x[i], y[i], 0) - topology.reference_position[i]) / 2;
        symbol.points.push_back({camera.pixel_x(p.x()), camera.pixel_y(p.y())});
    }
    return symbol;
}

}  // namespace hibi
