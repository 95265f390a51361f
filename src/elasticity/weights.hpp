#pragma once
#include <vector>

#include "model/model.hpp"

namespace hibi {

/// w(r) = r_e / r - 1 for r < r_e, else 0. Thesis eq. (2).
double weight(double r, double re);

/// Sum of weights seen by a particle deep inside the undisturbed square lattice, n0 [-]; ratio = r_e / l0.
template <int Dim>
double reference_number_density(double ratio);

/// The share s_ij of particle i's volume that a bond carries, for both directions (m^3). Fixed at the start:
/// surviving bonds are never renormalised after a break, which would raise the highest frequency.
struct BondWeights {
    std::vector<double> forward;   ///< s_ij with i = first, j = second
    std::vector<double> backward;  ///< s_ji
};

/// s_ij = V_i d g_ij w_ij / n_i with g_ij = n . B_i n and B_i such that sum_j s_ij n (x) n = V_i I: free
/// surfaces then strain like the interior. g is kept within [0.1, 5]; where the bonds of a particle span less
/// than the space, the condition holds in what they span.
template <int Dim>
BondWeights moment_matched_weights(const Model<Dim>& model);

/// s_ij = V_i d w_ij / n0, as in the thesis: particles at a surface lack what their missing neighbours would
/// carry. Across an interface, of which the thesis has none, both sides act in series: times 2 f mu_b / mu_i
/// (elastic_coefficients.hpp). Bonds turn by the mean angle of their ends, so that nothing more is needed.
template <int Dim>
BondWeights thesis_weights(const Model<Dim>& model);

/// Area vector of every particle, pointing out of the body (m^2); zero inside:
///     A_i = V sum_j (b_ji - b_ij),  b_ij = s_ij r0_ij / (V |r0_ij|^2)
/// A pressure spread by them does the work that a pressure on the face would. The particles behind the face
/// carry small areas of the other sign that belong to it.
template <int Dim>
std::vector<Vec<Dim>> nodal_areas(const Model<Dim>& model);

}  // namespace hibi
