#pragma once
#include <Eigen/SparseCore>
#include <array>
#include <vector>

#include "model/model.hpp"
#include "elasticity/bond_list.hpp"
#include "elasticity/elastic_coefficients.hpp"

namespace hibi {

/// Second derivative K of the moment-matched energy by the displacements (N/m), at any displacement and with
/// any bonds broken. Per particle, with Z = (tr A, A21 - A12), q = |Z|, z = Z / q and D = q - m:
///     d2U = dZ . [lambda V z z^T + (g' / q) (I - z z^T)] dZ,   g' = -2 mu V + lambda V D
/// plus springs of 2 mu s / |r0|^2 along every directed bond. It reaches the neighbours of neighbours.
template <int Dim>
class Tangent {
 public:
    /// Finds the pattern, once and for all from the bonds that are intact in the state, and linearises there.
    Tangent(const Model<Dim>& model, const State<Dim>& state);

    /// Linearises about the displacements of the state, without the bonds that have broken.
    void update(const State<Dim>& state);

    /// Adds so many times the springs of each particle to its diagonal, from now on: what is not positive
    /// definite becomes so.
    void shift(double share) { shift_ = share; }

    /// y = K x, from bond to bond: faster than by the assembled matrix, and without its memory.
    void multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const;

    /// Lower triangle (its diagonal blocks complete) with Dim * count columns. Rows and columns of held
    /// components are empty but for their diagonal; that of a particle without bonds is 1, since it resists
    /// nothing. Valid until the next call.
    const Eigen::SparseMatrix<double>& assemble(const std::vector<std::array<bool, 3>>& held);

 private:
    Tangent(const Model<Dim>& model, const State<Dim>& state, ElasticCoefficients coefficients);
    void find_pattern();

    BondList<Dim> list_;
    std::vector<double> volume_, two_mu_, lambda_;  ///< per particle
    std::vector<double> springs_;                   ///< sum over its bonds, both ends' (N/m)
    std::vector<Mat<Dim>> own_slope_;               ///< dZ_i / du_i (1/m)
    std::vector<Mat<Dim>> stiffness_;               ///< d2U_i / dZ_i2 (J)
    mutable std::vector<Vec<Dim>> pull_;            ///< of multiply: stiffness * dZ / V
    Eigen::SparseMatrix<double> matrix_;
    double shift_ = 0;
};

extern template class Tangent<2>;

/// Both triangles, with nothing held; for tests and estimates.
template <int Dim>
Eigen::SparseMatrix<double> tangent(const Model<Dim>& model, const State<Dim>& state);

/// Bound on the highest angular frequency (1/s) by the row sums of M^-1/2 K M^-1/2; safe at rest, 10-30 % too
/// high. Gershgorin 1931.
template <int Dim>
double frequency_bound(const Model<Dim>& model, const State<Dim>& state);

}  // namespace hibi
