#include "report/place.hpp"

#include <fmt/format.h>

#include <cmath>

namespace hibi {

Extent extent_of(const Topology& topology) {
    if (topology.reference_position.empty()) return {};
    Extent body{topology.reference_position[0], topology.reference_position[0]};
    for (const Vec3& X : topology.reference_position) {
        body.low = body.low.cwiseMin(X);
        body.high = body.high.cwiseMax(X);
    }
    return body;
}

namespace {

int third(const Extent& body, const Vec3& place, int axis) {
    const double span = body.high[axis] - body.low[axis];
    const double share = span > 0 ? (place[axis] - body.low[axis]) / span : 0.5;
    return share < 1.0 / 3 ? 0 : share > 2.0 / 3 ? 2 : 1;
}

}  // namespace

std::string place_in(const Extent& body, const Vec3& place) {
    static const char* const words[3][3] = {{"at the lower left", "at the bottom", "at the lower right"},
                                            {"at the left", "in the middle", "at the right"},
                                            {"at the upper left", "at the top", "at the upper right"}};
    return words[third(body, place, 1)][third(body, place, 0)];
}

std::string part_of(const Extent& body, const Vec3& place) {
    static const char* const words[3][3] = {
        {"on the lower left", "in the lower middle", "on the lower right"},
        {"on the left", "in the middle", "on the right"},
        {"on the upper left", "in the upper middle", "on the upper right"}};
    return words[third(body, place, 1)][third(body, place, 0)];
}

std::string place_text(const Vec3& place) {
    const auto rounded = [](double x) { return std::round(x * 1e12) / 1e12 + 0.0; };
    return fmt::format("({:.4g}, {:.4g}) m", rounded(place.x()), rounded(place.y()));
}

}  // namespace hibi
