#include "elasticity/tangent.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "elasticity/elastic_coefficients.hpp"

namespace hibi {

namespace {

/// d(tr A, A21 - A12) of a term own (x) r0 by the far end's displacement, times V.
Mat<2> turn_and_stretch(double own, const Vec<2>& r0) {
    Mat<2> C;
    C << own * r0.x(), own * r0.y(), -own * r0.y(), own * r0.x();
    return C;
}

}  // namespace

template <int Dim>
Tangent<Dim>::Tangent(const Model<Dim>& model, const State<Dim>& state)
    : Tangent(model, state, elastic_coefficients(model)) {}

template <int Dim>
Tangent<Dim>::Tangent(const Model<Dim>& model, const State<Dim>& state, ElasticCoefficients coefficients)
    : list_(model, coefficients.s), volume_(model.particles.volume), lambda_(std::move(coefficients.lambda)) {
    static_assert(Dim == 2, "Z is plane");
    const int n = model.particles.count();
    two_mu_.resize(n);
    for (int i = 0; i < n; ++i) {
        two_mu_[i] = 2 * shear_modulus(model.materials[model.particles.material[i]]);
    }
    springs_.resize(n);
    own_slope_.resize(n);
    stiffness_.resize(n);
    pull_.resize(n);
    update(state);
}

template <int Dim>
void Tangent<Dim>::find_pattern() {
    const int n = static_cast<int>(volume_.size());
    std::vector<std::vector<int>> rows(n);
    parallel_for(n, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            std::vector<int>& row = rows[i];
            row.push_back(i);
            for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
                if (list_.own[k] == 0 && list_.other[k] == 0) continue;
                const int j = list_.neighbour[k];
                if (j > i) row.push_back(j);
                for (int l = list_.start[j]; l < list_.start[j + 1]; ++l)
                    if (list_.neighbour[l] > i && list_.own[l] != 0) row.push_back(list_.neighbour[l]);
            }
            std::sort(row.begin(), row.end());
            row.erase(std::unique(row.begin(), row.end()), row.end());
        }
    });
    std::size_t entries = 0;
    for (const std::vector<int>& row : rows) entries += Dim * Dim * row.size();
    matrix_.resize(Dim * n, Dim * n);
    matrix_.resizeNonZeros(static_cast<Eigen::Index>(entries));
    int at = 0;
    for (int i = 0; i < n; ++i) {
        for (int a = 0; a < Dim; ++a) {
            matrix_.outerIndexPtr()[Dim * i + a] = at;
            for (const int k : rows[i])
                for (int b = 0; b < Dim; ++b) matrix_.innerIndexPtr()[at++] = Dim * k + b;
        }
    }
    matrix_.outerIndexPtr()[Dim * n] = at;
}

template <int Dim>
void Tangent<Dim>::update(const State<Dim>& state) {
    const std::vector<Vec<Dim>>& u = state.displacement;
    parallel_for(static_cast<int>(u.size()), [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const double V = volume_[i];
            Mat<2> slope = Mat<2>::Zero();
            Vec<2> Z = Vec<2>::Zero();  // less its value at rest (m, 0)
            double m = 0, springs = 0;
            for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
                if (!state.is_intact(list_.bond[k])) list_.own[k] = list_.other[k] = 0;
                const Mat<2> C = turn_and_stretch(list_.own[k], list_.r0[k]);
                slope -= C;
                Z += C * (u[list_.neighbour[k]] - u[i]);
                m += list_.own[k] * list_.r0[k].squaredNorm();
                springs += two_mu_[i] * list_.own[k] + two_mu_[list_.neighbour[k]] * list_.other[k];
            }
            springs_[i] = springs;
            own_slope_[i] = slope / V;
            Z /= V;
            m /= V;
            const double growth = Z.x() * (2 * m + Z.x()) + Z.y() * Z.y();  // q^2 - m^2
            Z.x() += m;
            const double q = Z.norm();
            stiffness_[i].setZero();
            if (!(q > 0)) continue;
            const Vec<2> z = Z / q;
            const Mat<2> along = z * z.transpose();
            const double D = growth / (q + m), across = (-two_mu_[i] + lambda_[i] * D) * V / q;
            stiffness_[i] = lambda_[i] * V * along + across * (Mat<2>::Identity() - along);
        }
    });
}

template <int Dim>
void Tangent<Dim>::multiply(const Eigen::VectorXd& x, Eigen::VectorXd& y) const {
    const auto at = [&](int i) -> Vec<2> { return x.segment<2>(2 * i); };
    const int n = static_cast<int>(volume_.size());
    parallel_for(n, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            double trace = 0, twist = 0;
            const Vec<2> xi = at(i);
            for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
                const Vec<2> dx = list_.own[k] * (at(list_.neighbour[k]) - xi), r0 = list_.r0[k];
                trace += dx.x() * r0.x() + dx.y() * r0.y();
                twist += dx.y() * r0.x() - dx.x() * r0.y();
            }
            pull_[i] = stiffness_[i] * Vec<2>(trace, twist) / (volume_[i] * volume_[i]);
        }
    });
    y.resize(2 * n);
    parallel_for(n, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            const Vec<2> xi = at(i);
            Vec<2> sum = shift_ * springs_[i] * xi;
            for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
                const int j = list_.neighbour[k];
                const double own = list_.own[k], other = list_.other[k];
                const Vec<2> r0 = list_.r0[k], w = own * pull_[i] + other * pull_[j];
                sum -= (own * two_mu_[i] + other * two_mu_[j]) * (at(j) - xi);
                sum.x() -= w.x() * r0.x() - w.y() * r0.y();
                sum.y() -= w.x() * r0.y() + w.y() * r0.x();
            }
            y.segment<2>(2 * i) = sum;
        }
    });
}

template <int Dim>
const Eigen::SparseMatrix<double>& Tangent<Dim>::assemble(const std::vector<std::array<bool, 3>>& held) {
    if (matrix_.nonZeros() == 0) find_pattern();
    const int n = static_cast<int>(volume_.size());
    parallel_for(n, [&](int begin, int end) {
        std::vector<Mat<Dim>> blocks;
        for (int i = begin; i < end; ++i) {
            // Column i; by symmetry its blocks are those of row i, transposed.
            const int first = matrix_.outerIndexPtr()[Dim * i],
                      size = matrix_.outerIndexPtr()[Dim * i + 1] - first;
            const int* rows = matrix_.innerIndexPtr() + first;
            blocks.assign(size / Dim, Mat<Dim>::Zero());
            const auto add = [&](int k, const Mat<Dim>& block) {
                if (k >= i) blocks[(std::lower_bound(rows, rows + size, Dim * k) - rows) / Dim] += block;
            };
            const auto add_particle = [&](int p, const Mat<Dim>& slope_at_i) {
                const Mat<Dim> left = slope_at_i.transpose() * stiffness_[p] / volume_[p];
                add(p, volume_[p] * left * own_slope_[p]);
                for (int k = list_.start[p]; k < list_.start[p + 1]; ++k)
                    if (list_.own[k] != 0)
                        add(list_.neighbour[k], left * turn_and_stretch(list_.own[k], list_.r0[k]));
            };
            add_particle(i, own_slope_[i]);
            for (int k = list_.start[i]; k < list_.start[i + 1]; ++k) {
                const int j = list_.neighbour[k];
                const double spring = two_mu_[i] * list_.own[k] + two_mu_[j] * list_.other[k];
                if (spring == 0) continue;
                add(i, spring * Mat<Dim>::Identity());
                add(j, -spring * Mat<Dim>::Identity());
                // seen from j, r0 is the other way round
                add_particle(j, turn_and_stretch(-list_.other[k], list_.r0[k]) / volume_[j]);
            }
            for (int a = 0; a < Dim; ++a) {
                double* column = matrix_.valuePtr() + first + a * size;
                for (int k = 0; k < size; ++k) {
                    const int j = rows[k] / Dim, b = rows[k] % Dim;
                    const double value = blocks[k / Dim](a, b);
                    const bool is_held = held[i][a] || held[j][b];
                    if (i == j && a == b)
                        column[k] = springs_[i] > 0 ? value + shift_ * springs_[i] : 1;
                    else
                        column[k] = is_held ? 0 : value;
                }
            }
        }
    });
    return matrix_;
}

template class Tangent<2>;

template <int Dim>
Eigen::SparseMatrix<double> tangent(const Model<Dim>& model, const State<Dim>& state) {
    Tangent<Dim> K(model, state);
    const std::vector<std::array<bool, 3>> free(model.particles.count());
    return K.assemble(free).template selfadjointView<Eigen::Lower>();
}

template <int Dim>
double frequency_bound(const Model<Dim>& model, const State<Dim>& state) {
    const Eigen::SparseMatrix<double> K = tangent(model, state);
    double bound = 0;
    for (int row = 0; row < K.outerSize(); ++row) {
        double sum = 0;
        for (Eigen::SparseMatrix<double>::InnerIterator at(K, row); at; ++at)
            sum += std::abs(at.value()) /
                   std::sqrt(model.particles.mass[row / Dim] * model.particles.mass[at.row() / Dim]);
        bound = std::max(bound, sum);
    }
    return std::sqrt(bound);
}

template Eigen::SparseMatrix<double> tangent<2>(const Model<2>&, const State<2>&);
template double frequency_bound<2>(const Model<2>&, const State<2>&);

}  // namespace hibi
