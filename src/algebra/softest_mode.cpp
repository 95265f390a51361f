#include "algebra/softest_mode.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>
#include <vector>

namespace hibi {

namespace {

constexpr int least_directions = 3, most_directions = 12;
/// Theta is good enough once another direction lowers it by less than this part of it: its sign is what
/// matters, but a shape to go along should be a good one.
constexpr double good_enough = 0.1, good_enough_to_follow = 0.01;

/// The same numbers on every machine.
Eigen::VectorXd noise(const Eigen::VectorXd& free) {
    std::mt19937 random(1);
    Eigen::VectorXd values(free.size());
    for (double& value : values) value = static_cast<double>(random()) / 0x1p31 - 1;
    return values.cwiseProduct(free);
}

}  // namespace

/// Random forces on all particles: what they do to the body is mostly its soft modes, of every symmetry.
void SoftestMode::go_on_with(Cholesky& factor, const Eigen::VectorXd& free) {
    factor_ = &factor;
    disturbance_.Mx = noise(free);
    factor.solve(disturbance_.Mx, disturbance_.x);
}

void SoftestMode::use(Cholesky& factor, const Eigen::VectorXd& free) {
    go_on_with(factor, free);
    if (last_.x.size() == 0) return;
    last_.Mx = last_.Mx.cwiseProduct(free);
    factor.solve(last_.Mx, last_.x);
}

double SoftestMode::follow(const Multiply& multiply) {
    std::vector<Pair> basis;
    std::vector<Eigen::VectorXd> images;  // K x
    Eigen::MatrixXd H(most_directions, most_directions);
    // Adds what of the pair is new. Twice is enough (Kahan).
    const auto add = [&](Pair pair) {
        const double before = pair.x.dot(pair.Mx);
        for (int pass = 0; pass < 2; ++pass) {
            for (const Pair& other : basis) {
                const double share = other.Mx.dot(pair.x);
                pair.x -= share * other.x;
                pair.Mx -= share * other.Mx;
            }
        }
        const double square = pair.x.dot(pair.Mx);
        if (!(square > 1e-20 * before)) return false;
        pair.x /= std::sqrt(square);
        pair.Mx /= std::sqrt(square);
        const int k = static_cast<int>(basis.size());
        multiply(pair.x, images.emplace_back());
        basis.push_back(std::move(pair));
        for (int j = 0; j <= k; ++j) H(j, k) = H(k, j) = basis[j].x.dot(images[k]);
        return true;
    };
    if (last_.x.size() > 0) add(last_);
    add(disturbance_);
    double theta = 0;
    for (;;) {
        const int k = static_cast<int>(basis.size());
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small(H.topLeftCorner(k, k));
        const double fall = theta - small.eigenvalues()[0];
        theta = small.eigenvalues()[0];
        const Eigen::VectorXd share = small.eigenvectors().col(0);
        last_ = {Eigen::VectorXd::Zero(disturbance_.x.size()), Eigen::VectorXd::Zero(disturbance_.x.size())};
        Eigen::VectorXd residual = last_.x;
        for (int j = 0; j < k; ++j) {
            last_.x += share[j] * basis[j].x;
            last_.Mx += share[j] * basis[j].Mx;
            residual += share[j] * images[j];
        }
        residual -= theta * last_.Mx;
        const double enough = (theta > 0 ? good_enough : good_enough_to_follow) * std::abs(theta);
        if ((k >= least_directions && fall <= enough) || k == most_directions) break;
        Pair next{{}, std::move(residual)};
        factor_->solve(next.Mx, next.x);
        if (!add(std::move(next))) break;
    }
    Eigen::Index largest = 0;
    last_.x.cwiseAbs().maxCoeff(&largest);
    if (last_.x[largest] < 0) {
        last_.x = -last_.x;
        last_.Mx = -last_.Mx;
    }
    return theta;
}

}  // namespace hibi
