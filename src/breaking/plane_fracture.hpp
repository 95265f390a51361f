#pragma once
#include "model/material.hpp"

namespace hibi {

/// Constant C of fracture_strain [-], for r_e = `influence` l0: interpolated between calibrated values, those
/// at the border of their range beyond it.
double fracture_constant(const Material& material, Assumption assumption, double influence);
/// Is the constant of a material between calibrated values? r_e = 1.5 ... 3.1 l0; nu = 0 ... 0.45.
bool fracture_is_calibrated(const Material& material, Assumption assumption, double influence);

/// Strain at which a bond of the given length (m) breaks so that opening a unit of crack area costs the
/// material's fracture energy Gc:
///     eps_max = C min(|r0| / l0, sqrt 2)^(1/5) sqrt(Gc / (E' l0))   [-]     Gc J/m^2, l0 m
/// E' = E in plane stress, E / (1 - nu^2) in plane strain (Pa). C is calibrated against K_I = F sigma
/// sqrt(pi a) of an edge-cracked strip: the middle of what 20, 40 and 80 particles across ask for, cracks
/// along the lattice and at 45 degrees to it (tests/breaking/calibration_test.cpp). It is not derived from a
/// bond-work integral, which is 1.7-2 times off for these weights.
///
/// The power of the length is a compromise. Without it a crack at 45 degrees is harder to drive than one
/// along the rows (by 20 % for nu = 0.3, r_e = 2.1 l0; by 8 % for 3.1 l0). The more longer bonds bear, the
/// nearer the two come; but from a power of about 1/4 on it is the diagonals across the wake that hold a
/// crack along the rows. The load then rises after the first bond, by an amount that hangs on the spacing:
/// with 3/4 the load at which a notched plate falls apart went up by 20 % over a fourfold refinement, with
/// 1/5 by 5 %.
double fracture_strain(const Material& material, Assumption assumption, double influence, double l0,
                       double length);

}  // namespace hibi
