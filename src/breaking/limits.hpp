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

/// Strain at which every bond fails, infinite where it never does: that of the weaker of its materials,
/// scattered where they ask for it. Bonds between two particles held in every direction, or both in a no-fail
/// grip, never fail.
///
/// A mixed bond (mixed_bonds.hpp) strains more in its softer part than as a whole, mu_b / mu times. With a
/// break strain it fails when that part reaches the strain: a thin layer breaks at the mean strain at which a
/// thick one does. With a fracture energy it fails when it stores what a bond of that material would, since
/// it is energy that a crack along the interface has to pay: at sqrt(mu / mu_b) times the material's strain.
template <int Dim>
std::vector<double> break_strains(const Model<Dim>& model, const Physics& physics);

/// The same as bounds on (L^2 - L0^2) / L0^2: thesis eq. (3), |(L - L0) / L0| > eps_max; tension only where
/// both materials say so.
template <int Dim>
BreakLimits break_limits(const Model<Dim>& model, const std::vector<double>& strains);

}  // namespace hibi
