#include "physics/tangent.hpp"

#include <algorithm>
#include <cmath>

#include "physics/bond_list.hpp"
#include "physics/dilatation.hpp"
#include "physics/weights.hpp"

namespace hibi {

/// Row by row. Particle p contributes dZ_p^T M_p dZ_p with Z_p = (tr A, A21 - A12) linear in the
/// displacements of p and its neighbours, M_p = diag(lambda V, -2 mu V / m) at rest, and its springs 2 mu s /
/// |r0|^2.
template <int Dim>
Eigen::SparseMatrix<double, Eigen::RowMajor> tangent_at_rest(const Model<Dim>& model) {
    static_assert(Dim == 2, "Z is plane");
    const Particles<Dim>& particles = model.particles;
    const int n = particles.count();
    const BondList<Dim> list(model, moment_matched_weights(model));
    const std::vector<double> lambda = dilatation_moduli(model);

    // dZ_p / du_j per slot, and dZ_p / du_p
    const auto slope = [&](int p, int k) {
        const Vec<2>& r0 = list.r0[k];
        Mat<2> C;
        C << r0.x(), r0.y(), -r0.y(), r0.x();
        return Mat<2>(list.own[k] / particles.volume[p] * C);
    };
    std::vector<Mat<2>> own_slope(n, Mat<2>::Zero());
    std::vector<Mat<2>> stiffness(n, Mat<2>::Zero());
    std::vector<double> two_mu(n);
    for (int p = 0; p < n; ++p) {
        const Material& material = model.materials[particles.material[p]];
        two_mu[p] = 2 * shear_modulus(material);
        double m = 0;
        for (int k = list.start[p]; k < list.start[p + 1]; ++k) {
            own_slope[p] -= slope(p, k);
            m += list.own[k] * list.r0[k].squaredNorm() / particles.volume[p];
        }
        stiffness[p](0, 0) = lambda[p] * particles.volume[p];
        if (m > 0) stiffness[p](1, 1) = -two_mu[p] * particles.volume[p] / m;
    }

    std::vector<std::vector<std::pair<int, Mat<2>>>> rows(n);
    std::vector<int> place(n, -1);
    for (int i = 0; i < n; ++i) {
        auto& row = rows[i];
        const auto add = [&](int k, const Mat<2>& block) {
            if (place[k] < 0) {
                place[k] = static_cast<int>(row.size());
                row.push_back({k, Mat<2>::Zero()});
            }
            row[place[k]].second += block;
        };
        const auto add_particle = [&](int p, const Mat<2>& slope_at_i) {
            const Mat<2> left = slope_at_i.transpose() * stiffness[p];
            add(p, left * own_slope[p]);
            for (int k = list.start[p]; k < list.start[p + 1]; ++k)
                add(list.neighbour[k], left * slope(p, k));
        };
        add_particle(i, own_slope[i]);
        for (int k = list.start[i]; k < list.start[i + 1]; ++k) {
            const int j = list.neighbour[k];
            const double spring = two_mu[i] * list.own[k] + two_mu[j] * list.other[k];
            add(i, spring * Mat<2>::Identity());
            add(j, -spring * Mat<2>::Identity());
            Mat<2> C;  // slope of j's Z by u_i: r0 seen from j is the other way round
            C << -list.r0[k].x(), -list.r0[k].y(), list.r0[k].y(), -list.r0[k].x();
            add_particle(j, list.other[k] / particles.volume[j] * C);
        }
        std::sort(row.begin(), row.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& entry : row) place[entry.first] = -1;
    }

    Eigen::SparseMatrix<double, Eigen::RowMajor> K(Dim * n, Dim * n);
    Eigen::VectorXi sizes(Dim * n);
    for (int i = 0; i < n; ++i)
        for (int a = 0; a < Dim; ++a) sizes[Dim * i + a] = Dim * static_cast<int>(rows[i].size());
    K.reserve(sizes);
    for (int i = 0; i < n; ++i)
        for (int a = 0; a < Dim; ++a)
            for (const auto& [k, block] : rows[i])
                for (int b = 0; b < Dim; ++b) K.insert(Dim * i + a, Dim * k + b) = block(a, b);
    K.makeCompressed();
    return K;
}

template <int Dim>
double frequency_bound(const Model<Dim>& model) {
    const Eigen::SparseMatrix<double, Eigen::RowMajor> K = tangent_at_rest(model);
    double bound = 0;
    for (int row = 0; row < K.outerSize(); ++row) {
        double sum = 0;
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator at(K, row); at; ++at)
            sum += std::abs(at.value()) /
                   std::sqrt(model.particles.mass[row / Dim] * model.particles.mass[at.col() / Dim]);
        bound = std::max(bound, sum);
    }
    return std::sqrt(bound);
}

template Eigen::SparseMatrix<double, Eigen::RowMajor> tangent_at_rest<2>(const Model<2>&);
template double frequency_bound<2>(const Model<2>&);

}  // namespace hibi
