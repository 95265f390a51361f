#include "elasticity/moment_factors.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace hibi {

template <int Dim>
Symmetric<Dim> dyad(const Vec<Dim>& n) {
    Symmetric<Dim> v;
    int k = 0;
    for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b) v[k++] = (a == b ? 1.0 : std::sqrt(2.0)) * n[a] * n[b];
    return v;
}

template <int Dim>
Symmetric<Dim> identity() {
    Symmetric<Dim> I = Symmetric<Dim>::Zero();
    for (int a = 0; a < Dim; ++a) I += dyad<Dim>(Vec<Dim>::Unit(a));
    return I;
}

namespace {
constexpr double smallest_factor = 0.1, largest_factor = 5, rank_tolerance = 1e-9;
}

template <int Dim>
std::vector<double> moment_factors(const std::vector<Vec<Dim>>& normals, const std::vector<double>& share,
                                   const Symmetric<Dim>& target) {
    constexpr int size = Dim * (Dim + 1) / 2;
    const std::size_t count = normals.size();
    std::vector<Symmetric<Dim>> dyads(count);
    for (std::size_t k = 0; k < count; ++k) dyads[k] = dyad<Dim>(normals[k]);

    std::vector<double> factor(count, 1.0);
    std::vector<bool> frozen(count, false);
    for (int pass = 0; pass < 5; ++pass) {
        Eigen::Matrix<double, size, size> M;
        M.setZero();
        Symmetric<Dim> rest = target;
        for (std::size_t k = 0; k < count; ++k) {
            if (frozen[k])
                rest -= share[k] * factor[k] * dyads[k];
            else
                M += share[k] * dyads[k] * dyads[k].transpose();
        }
        // Pseudo-inverse: a row of particles, or a single bond, is matched in the subspace its bonds span.
        const Eigen::SelfAdjointEigenSolver<decltype(M)> eigen(M);
        const double largest = eigen.eigenvalues().cwiseAbs().maxCoeff();
        Symmetric<Dim> B = Symmetric<Dim>::Zero();
        for (int k = 0; k < size; ++k) {
            const double value = eigen.eigenvalues()[k];
            if (value > rank_tolerance * largest)
                B += eigen.eigenvectors().col(k) * (eigen.eigenvectors().col(k).dot(rest) / value);
        }
        bool clamped = false;
        for (std::size_t k = 0; k < count; ++k) {
            if (frozen[k]) continue;
            factor[k] = dyads[k].dot(B);
            if (factor[k] < smallest_factor || factor[k] > largest_factor) {
                factor[k] = std::clamp(factor[k], smallest_factor, largest_factor);
                frozen[k] = clamped = true;
            }
        }
        if (!clamped) break;
    }
    return factor;
}

template Symmetric<2> dyad<2>(const Vec<2>&);
template Symmetric<2> identity<2>();
template std::vector<double> moment_factors<2>(const std::vector<Vec<2>>&, const std::vector<double>&,
                                               const Symmetric<2>&);

}  // namespace hibi
