#pragma once
#include <span>
#include <vector>

#include "physics/simulation.hpp"

namespace hibi {

/// How far a body has swung along the motion it began with:
///     q = sum m v0 . u / sum m v0 . v0        [s]
/// Where it began in a mode of vibration, q = sin(w t) / w; other modes in v0 enter by the square of their
/// part.
template <int Dim>
class Swing {
 public:
    explicit Swing(const Model<Dim>& model);    ///< at the start of the run
    bool exists() const { return scale_ > 0; }  ///< does anything move at the start?
    double operator()(const Model<Dim>& model) const;

 private:
    std::vector<Vec<Dim>> momentum_;  ///< m v0 of each particle (kg m/s)
    double scale_ = 0;                ///< sum m v0 . v0 (J)
};

/// The period (s) of a swing that begins at zero: from its last passage through zero, interpolated. Nothing
/// where it has not passed any. `times` rise; both are as long.
std::optional<double> period_of(std::span<const double> times, std::span<const double> swing);

/// About the origin, the particles' own spin included where they have one (kg m^2/s).
double angular_momentum(const Model<2>& model);

extern template class Swing<2>;

}  // namespace hibi
