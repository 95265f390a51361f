#pragma once
#include <Eigen/Core>
#include <vector>

#include "base/vec.hpp"

namespace hibi {

/// Components of a symmetric matrix as a vector whose dot product is the matrix product's trace.
template <int Dim>
using Symmetric = Eigen::Matrix<double, Dim*(Dim + 1) / 2, 1>;

/// n (x) n
template <int Dim>
Symmetric<Dim> dyad(const Vec<Dim>& n);
template <int Dim>
Symmetric<Dim> identity();

/// The factors g = n . B n of one particle's bonds with which sum_j share_j g_j n (x) n is `target`. g is
/// kept within [0.1, 5]; where the bonds span less than the space, the condition holds in what they span.
template <int Dim>
std::vector<double> moment_factors(const std::vector<Vec<Dim>>& normals, const std::vector<double>& share,
                                   const Symmetric<Dim>& target);

}  // namespace hibi
