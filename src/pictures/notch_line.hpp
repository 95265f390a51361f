#pragma once
#include <array>
#include <span>
#include <vector>

#include "image/overlay.hpp"
#include "results/snapshot.hpp"

namespace hibi {

/// A notch bound to the particles along it, so that it moves with the body.
struct NotchLine {
    std::vector<Vec3> points;                ///< along the notch, where it has a particle on both sides (m)
    std::vector<std::array<int, 2>> beside;  ///< the nearest particle on either side
};

std::vector<NotchLine> find_notches(const Topology& topology);

/// The notch at this moment, in the middle between its sides, without the parts that stand wide open: x, y
/// are positions of all particles (m).
Symbol place_notch(const NotchLine& notch, const Topology& topology, std::span<const double> x,
                   std::span<const double> y, const Camera2& camera);

}  // namespace hibi
