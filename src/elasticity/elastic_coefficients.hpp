#pragma once
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "elasticity/weights.hpp"

namespace hibi {

/// What stress and dilatation of a particle at an interface are taken from, in place of its energy's
/// coefficients: these are right for the forces that its bonds bear together, but not for its own strain.
struct Gauge {
    int particle = 0;
    double lambda = 0;                            ///< (Pa)
    std::vector<std::pair<int, double>> bonds{};  ///< bond and s_ij (m^3)
};

/// All that the moment-matched energy takes from the bodies:
///     U = sum_i { mu_i sum_j s_ij |r - R_i r0|^2 / |r0|^2 + lambda_i V D_i^2 / 2 }
/// with mu of the particle's material.
struct ElasticCoefficients {
    BondWeights s;
    std::vector<double> lambda;   ///< per particle (Pa)
    std::vector<Gauge> gauges{};  ///< of the particles at an interface, rising
};

/// Where all materials have one shear modulus: moment_matched_weights and dilatation_moduli. Across an
/// interface both sides of a bond act in series, as two springs that share its length:
///
///     s_ij -> 2 p_i mu_b / mu_i s_ij,    p_i + p_j = 1,    1 / mu_b = mean of 1 / mu along the bond
///
/// so that the spring of a bond whose ends weigh it alike is 2 mu_b (s_ij + s_ji). A stress across the
/// interface is then the same on both sides, whatever their stiffness: tension across passes the patch test.
/// It stays one energy with the same loops; only its weights change.
///
/// p shares the spring out between the ends. Each end's part turns with that end, and counts in that end's
/// dilatation. With p = f, the part of the bond's length on the end's own side, dilatations are right. But in
/// shear along the interface both sides turn by different angles, and a bond that follows two rotations is
/// too stiff. It is less so the more of the spring the softer side has: p = (1 - a) f + a q, with q the end's
/// part of the compliance; a = 0.4 makes shear right. On the softer side the dilatation then overstates a
/// stretch across the interface t > 1 times, and lambda / t^2 makes up for that. It does so less well the
/// nearer a material is to incompressible: there a falls to 0.
///
/// The bonds of a particle into its own material are matched anew, so that it still measures a stretch along
/// the interface, which is common to both sides: there the stiffnesses add in parallel.
///
/// Measured, error of the stored energy between given displacements in a strip of 18 by 5 particles (r_e =
/// 2.1 l0, plane stress, nu = 0.3, E 1:1000), in per cent: tension across the interface / shear along it /
/// tension along it
///                                        half and half          soft layer of one particle
///     both sides in parallel             +14.6 / +23.3 / 0      +4805 / +6569 / 0
///     p = f, own bonds as they were      0.0 / +2.5 / -1.8      -0.9 / +40 / -1.8
///     p = f                              0.0 / +2.1 / +0.6      -0.9 / +34 / +0.6
///     a = 0.4                            +1.2 / 0.0 / +0.6      +27 / -0.5 / +0.6
///     a = 0.4 and lambda / t^2           0.0 / 0.0 / +0.6       -0.7 / -0.2 / +0.6
/// Contrasts of 3 and 10, and nu of 0 against 0.45: within 0.2 / 0.1 / 1.1. Interface at 45 degrees to the
/// rows: 0.0 / +1.0 / +0.5, but -24 / +4 / +0.5 with a soft layer of two rows, and a single row does not
/// separate what lies on its sides. Without the fall of a, a layer of two particles of nu = 0.49 in plane
/// strain is 37 % soft in tension across.
template <int Dim>
ElasticCoefficients elastic_coefficients(const Model<Dim>& model);

}  // namespace hibi
