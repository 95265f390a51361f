#pragma once
#include <array>

#include "base/vec.hpp"

namespace hibi {

/// Unit vectors across a direction: in the plane, the two there are.
template <int Dim>
auto sideways(const Vec<Dim>& direction) {
    static_assert(Dim == 2, "across a direction in space there is a circle");
    const Vec<2> left = Vec<2>(-direction.y(), direction.x()).normalized();
    return std::array<Vec<2>, 2>{left, -left};
}

}  // namespace hibi
