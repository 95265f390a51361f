#pragma once
#include <Eigen/SparseCore>

#include "model/model.hpp"

namespace hibi {

/// Second derivative of the moment-matched energy by the displacements, unloaded and undamaged (N/m): Dim *
/// count rows, both triangles. It reaches the neighbours of neighbours.
template <int Dim>
Eigen::SparseMatrix<double, Eigen::RowMajor> tangent_at_rest(const Model<Dim>& model);

/// Bound on the highest angular frequency (1/s) by the row sums of M^-1/2 K M^-1/2; always safe, 10-30 % too
/// high. Gershgorin 1931.
template <int Dim>
double frequency_bound(const Model<Dim>& model);

}  // namespace hibi
