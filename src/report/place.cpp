#include "report/place.hpp"

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

std::string place_in(const Extent& body, const Vec3& place) {
    const auto third = [&](int axis) {
        const double span = body.high[axis] - body.low[axis];
        const double share = span > 0 ? (place[axis] - body.low[axis]) / span : 0.5;
        return share < 1.0 / 3 ? 0 : share > 2.0 / 3 ? 2 : 1;
    };
    static const char* const words[3][3] = {{"at the lower left", "at the bottom", "at the lower right"},
                                            {"at the left", "in the middle", "at the right"},
                                            {"at the upper left", "at the top", "at the upper right"}};
    return words[third(1)][third(0)];
}

}  // namespace hibi
