#include "physics/weights.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "base/parallel.hpp"

namespace hibi {

double weight(double r, double re) { return r < re ? re / r - 1 : 0; }

template <int Dim>
double reference_number_density(double ratio) {
    static_assert(Dim == 2, "the sum below is plane");
    const int reach = static_cast<int>(std::ceil(ratio));
    double sum = 0;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x)
            if (x != 0 || y != 0) sum += weight(std::hypot(x, y), ratio);
    return sum;
}

namespace {

/// Components of a symmetric matrix as a vector whose dot product is the matrix product's trace.
template <int Dim>
constexpr int symmetric_size = Dim*(Dim + 1) / 2;
template <int Dim>
using Symmetric = Eigen::Matrix<double, symmetric_size<Dim>, 1>;

template <int Dim>
Symmetric<Dim> dyad(const Vec<Dim>& n) {
    Symmetric<Dim> v;
    int k = 0;
    for (int a = 0; a < Dim; ++a)
        for (int b = a; b < Dim; ++b) v[k++] = (a == b ? 1.0 : std::sqrt(2.0)) * n[a] * n[b];
    return v;
}

constexpr double smallest_factor = 0.1, largest_factor = 5, rank_tolerance = 1e-9;

/// The factors g of one particle: n . B n, clamped. `share` is d w / n per bond.
template <int Dim>
std::vector<double> moment_factors(const std::vector<Vec<Dim>>& normals, const std::vector<double>& share) {
    const std::size_t count = normals.size();
    std::vector<Symmetric<Dim>> dyads(count);
    for (std::size_t k = 0; k < count; ++k) dyads[k] = dyad<Dim>(normals[k]);
    Symmetric<Dim> identity = Symmetric<Dim>::Zero();
    for (int a = 0; a < Dim; ++a) identity += dyad<Dim>(Vec<Dim>::Unit(a));

    std::vector<double> factor(count, 1.0);
    std::vector<bool> frozen(count, false);
    for (int pass = 0; pass < 5; ++pass) {
        Eigen::Matrix<double, symmetric_size<Dim>, symmetric_size<Dim>> M;
        M.setZero();
        Symmetric<Dim> rest = identity;
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
        for (int k = 0; k < symmetric_size<Dim>; ++k) {
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

}  // namespace

template <int Dim>
BondWeights moment_matched_weights(const Model<Dim>& model) {
    const Particles<Dim>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    BondWeights s{std::vector<double>(bonds.count()), std::vector<double>(bonds.count())};
    parallel_for(particles.count(), [&](int begin, int end) {
        std::vector<Vec<Dim>> normals;
        std::vector<double> share;
        for (int i = begin; i < end; ++i) {
            normals.clear();
            share.clear();
            double density = 0;
            for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
                const int b = bonds.bonds_of[k], j = bonds.other(b, i);
                normals.push_back((particles.reference_position[j] - particles.reference_position[i]) /
                                  bonds.rest_length[b]);
                share.push_back(weight(bonds.rest_length[b], model.influence * particles.spacing[i]));
                density += share.back();
            }
            for (double& w : share) w *= Dim / density;
            const std::vector<double> factor = moment_factors<Dim>(normals, share);
            for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
                const int b = bonds.bonds_of[k], local = k - bonds.start[i];
                auto& mine = bonds.first[b] == i ? s.forward : s.backward;
                mine[b] = particles.volume[i] * factor[local] * share[local];
            }
        }
    });
    return s;
}

template <int Dim>
BondWeights thesis_weights(const Model<Dim>& model) {
    const Particles<Dim>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    const double n0 = reference_number_density<Dim>(model.influence);
    BondWeights s{std::vector<double>(bonds.count()), std::vector<double>(bonds.count())};
    parallel_for(bonds.count(), [&](int begin, int end) {
        for (int b = begin; b < end; ++b) {
            const int i = bonds.first[b], j = bonds.second[b];
            const double w = weight(bonds.rest_length[b], model.influence * particles.spacing[i]);
            s.forward[b] = particles.volume[i] * Dim * w / n0;
            s.backward[b] = particles.volume[j] * Dim * w / n0;
        }
    });
    return s;
}

template <int Dim>
std::vector<Vec<Dim>> nodal_areas(const Model<Dim>& model) {
    const Particles<Dim>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    const BondWeights s = moment_matched_weights(model);
    std::vector<Vec<Dim>> areas(particles.count(), Vec<Dim>::Zero());
    for (int b = 0; b < bonds.count(); ++b) {
        const int i = bonds.first[b], j = bonds.second[b];
        const Vec<Dim> r0 = particles.reference_position[j] - particles.reference_position[i];
        const Vec<Dim> flux = (s.forward[b] + s.backward[b]) / r0.squaredNorm() * r0;
        areas[i] -= flux;
        areas[j] += flux;
    }
    return areas;
}

template double reference_number_density<2>(double);
template BondWeights moment_matched_weights<2>(const Model<2>&);
template BondWeights thesis_weights<2>(const Model<2>&);
template std::vector<Vec<2>> nodal_areas<2>(const Model<2>&);

}  // namespace hibi
