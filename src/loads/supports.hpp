#pragma once
#include <array>
#include <vector>

#include "model/state.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// Per particle, which of its components are held: [i][a]. The one place that knows.
using HeldComponents = std::vector<std::array<bool, 3>>;

/// Held by supports alone.
HeldComponents held_by_supports(int particles, const Physics& physics);
/// Held by supports, or driven by a load that has not been released.
HeldComponents held_or_driven(int particles, const Physics& physics, const std::vector<char>& released = {});

/// Is every component of the space held?
template <int Dim>
bool all_held(const std::array<bool, 3>& axes) {
    for (int a = 0; a < Dim; ++a)
        if (!axes[a]) return false;
    return true;
}

/// Which particles a chain of intact bonds ties to one that is held in some direction.
template <int Dim>
std::vector<char> tied_to_support(const Bonds& bonds, const State<Dim>& state, const HeldComponents& held);

}  // namespace hibi
