#pragma once
#include <Eigen/Core>
#include <functional>

#include "algebra/cholesky.hpp"

namespace hibi {

/// Smallest theta of K x = theta M x, where K is symmetric and M is the matrix of a factor at hand. K is
/// positive definite exactly where theta > 0 (Sylvester's law of inertia), and where M is an earlier tangent
/// nearly all theta are close to 1: a buckling mode stands alone, and few products and solves find it. By
/// Davidson's method, with M as preconditioner; begun anew from the last shape and from one disturbance.
class SoftestMode {
 public:
    /// Writes K x (N/m times the unit of x), with zeros where x is held.
    using Multiply = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& Kx)>;

    /// Rows for which `free` is 0 are held: x is 0 there. To be called again whenever the factor changes; the
    /// shape is kept.
    void use(Cholesky& factor, const Eigen::VectorXd& free);

    /// Theta (an upper bound, off by a tenth where it is positive) and its shape.
    double follow(const Multiply& multiply);

    /// With x^T M x = 1; the largest component is positive. Empty before the first call of follow().
    const Eigen::VectorXd& shape() const { return last_.x; }
    /// What M makes of it.
    const Eigen::VectorXd& image() const { return last_.Mx; }

    /// Goes on from the shape and image of another one: as if follow() had found them here.
    void restore(Eigen::VectorXd shape, Eigen::VectorXd image) { last_ = {std::move(shape), std::move(image)}; }
    /// Like use(), for a factor to which the shape belongs already.
    void go_on_with(Cholesky& factor, const Eigen::VectorXd& free);

 private:
    /// A vector and what M makes of it: M itself is not needed.
    struct Pair {
        Eigen::VectorXd x, Mx;
    };

    Cholesky* factor_ = nullptr;
    Pair last_, disturbance_;
};

}  // namespace hibi
