#pragma once
#include "base/vec.hpp"

namespace hibi {

// Answers that are known without particles: what `hibi verify` judges a run by. SI units; plates are 1 m
// thick. Plane strain acts like plane stress with E / (1 - nu^2) and nu / (1 - nu), see plane_strain().

/// Young's modulus (Pa) and Poisson's ratio as a theory of plane stress sees them.
struct PlaneConstants {
    double youngs_modulus = 0, poissons_ratio = 0;
};
PlaneConstants plane_strain(double youngs_modulus, double poissons_ratio);

/// Displacement (m) at (x, y) of a cantilever of plane stress, -height/2 < y < height/2, whose end x = length
/// carries a parabolic shear of resultant `force` (N) along +y, and whose root x = 0 moves as the solution
/// says. Timoshenko and Goodier, Theory of Elasticity, art. 21, in the form of Augarde and Deeks, Finite
/// Elements in Analysis and Design 44 (2008) 595.
Vec<2> cantilever_displacement(double x, double y, double force, double length, double height,
                               PlaneConstants material);

/// A rectangular beam whose sections shear and turn: Timoshenko's theory, with Cowper's shear coefficient
/// 10 (1 + nu) / (12 + 11 nu), Journal of Applied Mechanics 33 (1966) 335.
struct TimoshenkoBeam {
    double length = 0, height = 0;  ///< (m)
    double density = 0;             ///< (kg/m^3)
    PlaneConstants material;
};
/// Longest period (s) of the beam: both ends free; one clamped and the other free.
double free_free_period(const TimoshenkoBeam& beam);
double clamped_free_period(const TimoshenkoBeam& beam);

/// First period (s) of a plate in plane strain, nu = 0.3975, ten times as long as high, clamped at one end.
/// There the clamped edge cannot grow or shrink across the plate, which no beam theory knows: finite elements
/// of the plane (nine nodes, refined towards the edge until the fifth digit stood) give 0.25522 s for 0.2 m x
/// 0.02 m, 2 MPa, 1000 kg/m^3, which is 0.9954 of Timoshenko's theory, and as much for a plate 1 % longer.
double clamped_plate_period(double length, double height, double youngs_modulus, double density);

/// Longest period (s) of a free bar along its length: 2 L sqrt(rho / E), longer by the inertia of its
/// thickening, sqrt(1 + (nu k height)^2 / 12), k = pi / L. Love, A Treatise on the Mathematical Theory of
/// Elasticity, section 278, for a bar that is free to change its height alone.
double bar_period(double length, double height, double density, PlaneConstants material);

/// Where the end of a thin cantilever goes under a force P that keeps its direction across it: distance from
/// the clamp along and across the straight beam, over its length. `load` = P L^2 / (E I) > 0. Elliptic
/// integrals: Bisshopp and Drucker, Quarterly of Applied Mathematics 3 (1945) 272.
Vec<2> elastica_end(double load);

/// F in K = F sigma sqrt(pi a): a strip of width W under uniform tension sigma with an edge crack of length
/// a, ratio = a / W <= 0.6; within 0.5 %. Brown and Srawley 1966; Tada, Paris and Irwin, The Stress Analysis
/// of Cracks Handbook.
double edge_crack_factor(double ratio);

}  // namespace hibi
