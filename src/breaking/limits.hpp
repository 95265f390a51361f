#pragma once
#include <vector>

#include "model/model.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// Limit strain of a bond that follows from the fracture energy of a material (m, m). What it is in the plane
/// says plane_fracture.hpp.
template <int Dim>
double fracture_strain(const Model<Dim>& model, const Material& material, double l0, double length);
template <>
double fracture_strain<2>(const Model<2>& model, const Material& material, double l0, double length);

/// Strain at which every bond fails, infinite where it never does: the weaker of its two materials, scattered
/// where they ask for it. Bonds between two particles held in every direction, or both in a no-fail grip,
/// never fail.
template <int Dim>
std::vector<double> break_strains(const Model<Dim>& model, const Physics& physics);

/// The same as bounds on (L^2 - L0^2) / L0^2: thesis eq. (3), |(L - L0) / L0| > eps_max; tension only where
/// both materials say so.
template <int Dim>
BreakLimits break_limits(const Model<Dim>& model, const std::vector<double>& strains);

}  // namespace hibi
