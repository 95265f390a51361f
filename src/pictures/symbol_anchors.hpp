#pragma once
#include <array>
#include <span>
#include <vector>

#include "image/overlay.hpp"
#include "results/snapshot.hpp"

namespace hibi {

/// A support or load bound to the particles that carry its symbol, found once in the unloaded body.
struct SymbolAnchor {
    Symbol::Kind kind = Symbol::Kind::clamp;
    std::vector<int> particles;            ///< along the outline, in order
    double radius = 0;                     ///< of a particle (m)
    std::array<double, 2> towards{0, -1};  ///< support: away from the body; load: its direction. y up
    bool pulls = false;                    ///< load: drawn from the body outward, not onto it
    int load = -1;                         ///< index into Topology::loads
};

/// The outline of held particles away from the body (one anchor per unbroken stretch), and of loaded
/// particles where the arrows come from, or where they go to if the body itself lies in their way.
std::vector<SymbolAnchor> find_symbol_anchors(const Topology& topology, bool supports, bool loads);

/// A place (m) that has to be in the picture, with room around it in pixels: left, top, right, bottom.
struct Reserved {
    double x = 0, y = 0;
    std::array<double, 4> room{};
};

/// The places of an anchor's particles with the room that its symbol needs; arguments as in place_symbol.
std::vector<Reserved> reserve(const SymbolAnchor& anchor, std::span<const double> x,
                              std::span<const double> y, double size, const View& view);

/// Shows the window (x0, y0, x1, y1 in m), a margin and all reserved places in the plot, as large as
/// possible.
Camera2 camera_for(const std::array<double, 4>& window, std::span<const Reserved> reserved,
                   const PixelRect& plot);

/// The symbol at this moment: x, y are positions of all particles (m). `size` is the load's share of its
/// largest value, negative where it has changed sign. Arrows are thinned out to a readable distance.
Symbol place_symbol(const SymbolAnchor& anchor, std::span<const double> x, std::span<const double> y,
                    const Camera2& camera, double size, double unit);

}  // namespace hibi
