#pragma once
#include <vector>

#include "model/model.hpp"

namespace hibi {

/// lambda of each particle's dilatation (Pa), away from interfaces: that of its material. But a particle
/// whose bonds lie on one line has none that could carry stress across it; it contracts freely there, which
/// leaves
///     2 mu lambda / (2 mu + lambda)
/// A single row of particles then has the stiffness of a bar, E A / L, and not that of uniaxial strain; in
/// plane strain E / (1 - nu^2) takes the place of E.
template <int Dim>
std::vector<double> dilatation_moduli(const Model<Dim>& model);

}  // namespace hibi
