#pragma once
#include <vector>

#include "model/model.hpp"
#include "physics/elastic.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// Bond strain at which a crack along the lattice advances when opening a unit of area costs Gc:
///     eps_max = C sqrt(Gc / (E l0))   [-]     Gc J/m^2, E Pa, l0 m
/// C calibrated against K_I = F sigma sqrt(pi a) of an edge-cracked plate (plane stress, nu = 0.3, r_e = 2.1
/// l0); it is not derived from a bond-work integral, which is 1.7-2 times off for these weights.
double fracture_strain(double Gc, double E, double l0);

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
