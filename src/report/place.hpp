#pragma once
#include <string>

#include "results/snapshot.hpp"

namespace hibi {

/// Box around the particle centres of the unloaded body (m).
struct Extent {
    Vec3 low = Vec3::Zero(), high = Vec3::Zero();
};
Extent extent_of(const Topology& topology);

/// Where at the body a support, a load or a notch is, in thirds: "at the upper left", "at the top".
std::string place_in(const Extent& body, const Vec3& place);
/// Where inside the body a place is, in thirds: "on the left", "in the upper middle". It is not said on which side
/// of a beam: that is what coordinates are for.
std::string part_of(const Extent& body, const Vec3& place);
/// "(3, 3.45) m"; rounding is no coordinate.
std::string place_text(const Vec3& place);

}  // namespace hibi
