#pragma once
#include <string>

#include "measure/snapshot.hpp"

namespace hibi {

/// Box around the particle centres of the unloaded body (m).
struct Extent {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
};
Extent extent_of(const Topology& topology);

/// Where in the body a place is, in thirds: "at the upper left".
std::string place_in(const Extent& body, const Vec3& place);

}  // namespace hibi
