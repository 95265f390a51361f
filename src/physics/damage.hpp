#pragma once
#include <vector>

#include "model/model.hpp"
#include "physics/elastic.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// Constant C of fracture_strain [-], for r_e = `influence` l0: interpolated between calibrated values, those
/// at the border of their range beyond it.
double fracture_constant(const Material& material, Assumption assumption, double influence);
/// Is the constant of a material between calibrated values? r_e = 1.5 ... 3.1 l0; nu = 0 ... 0.45.
bool fracture_is_calibrated(const Material& material, Assumption assumption, double influence);

/// Strain at which a bond of the given length (m) breaks so that opening a unit of crack area costs the
/// material's fracture energy Gc:
///     eps_max = C min(|r0| / l0, sqrt 2)^(3/4) sqrt(Gc / (E' l0))   [-]     Gc J/m^2, l0 m
/// E' = E in plane stress, E / (1 - nu^2) in plane strain (Pa). C is calibrated against K_I = F sigma
/// sqrt(pi a) of an edge-cracked strip, cracks along the lattice and at 45 degrees to it weighing the same
/// (tests/physics/calibration_test.cpp); it is not derived from a bond-work integral, which is 1.7-2 times
/// off for these weights. With one limit for all bonds a body is 20 % stronger at 45 degrees than along the
/// lattice (nu = 0.3, r_e = 2.1 l0, 40 particles across); the power of the length was chosen to bring that to
/// 1 %. r_e below 2 l0 leaves a crack's resistance to chance and direction (up to 35 %): too few bonds cross
/// it.
double fracture_strain(const Material& material, Assumption assumption, double influence, double l0,
                       double length);

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
