#include "pictures/drawing_origin.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hibi {

namespace {

/// A window at most so many times its own size away from the origin loses less than a hundredth of a pixel in
/// single precision.
constexpr double most_sizes_away = 16;

bool is_near(const Vec3& origin, const std::array<double, 4>& window) {
    const std::array<double, 4> w = counted_from(origin, window);
    double away = 0;
    for (const double corner : w) away = std::max(away, std::abs(corner));
    return away <= most_sizes_away * std::max(w[2] - w[0], w[3] - w[1]);
}

}  // namespace

Vec3 drawing_origin(const Topology& topology, const std::optional<std::array<double, 4>>& window) {
    if (topology.reference_position.empty()) return Vec3::Zero();
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 4> body{far, far, -far, -far};
    for (std::size_t i = 0; i < topology.reference_position.size(); ++i) {
        const Vec3& X = topology.reference_position[i];
        const double r = topology.spacing[i] / 2;
        body = {std::min(body[0], X.x() - r), std::min(body[1], X.y() - r), std::max(body[2], X.x() + r),
                std::max(body[3], X.y() + r)};
    }
    const std::array<double, 4> shown = window.value_or(body);
    for (const Vec3& origin : {Vec3(0, 0, 0), Vec3(body[0], body[1], 0)})
        if (is_near(origin, shown)) return origin;
    return {shown[0], shown[1], 0};
}

std::array<double, 4> counted_from(const Vec3& origin, const std::array<double, 4>& window) {
    return {window[0] - origin.x(), window[1] - origin.y(), window[2] - origin.x(), window[3] - origin.y()};
}

Topology counted_from(const Vec3& origin, Topology topology) {
    for (Vec3& X : topology.reference_position) X -= origin;
    for (std::array<Vec3, 2>& notch : topology.notches)
        for (Vec3& end : notch) end -= origin;
    return topology;
}

const Topology& topology_from(const Vec3& origin, const RunReader& run) {
    if (origin == Vec3::Zero()) return run.topology();
    return run.once<Topology>(fmt::format("topology_from {} {}", origin.x(), origin.y()),
                              [&] { return counted_from(origin, run.topology()); });
}

}  // namespace hibi
