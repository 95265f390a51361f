#pragma once
#include <Eigen/Core>

namespace hibi {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using Mat = Eigen::Matrix<double, Dim, Dim>;
using Vec3 = Vec<3>;

/// Padded with zeros to three components: what is recorded and drawn is always three-dimensional.
template <int Dim>
Vec3 to_3d(const Vec<Dim>& v) {
    Vec3 r = Vec3::Zero();
    r.template head<Dim>() = v;
    return r;
}

}  // namespace hibi
