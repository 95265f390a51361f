#pragma once
#include <optional>
#include <span>
#include <vector>

#include "simulation/simulation.hpp"

namespace hibi {

/// How far a body has moved along the motion it began with:
///     q = sum m v0 . u / sum m v0 . v0        [s]
/// Where it began in a mode of vibration, q = sin(w t) / w; other modes in v0 enter by the square of their
/// part.
class ModalDisplacement {
 public:
    explicit ModalDisplacement(const Simulation& simulation);  ///< at the start of the run
    bool exists() const { return scale_ > 0; }                 ///< does anything move at the start?
    double operator()(const Simulation& simulation) const;

 private:
    std::vector<Vec3> momentum_;  ///< m v0 of each particle (kg m/s)
    double scale_ = 0;            ///< sum m v0 . v0 (J)
};

/// The period (s) of a displacement that begins at zero: from its last passage through zero, interpolated.
/// Nothing where it has not passed any. `times` rise; both are as long.
std::optional<double> period_of(std::span<const double> times, std::span<const double> displacement);

/// About the origin, the particles' own spin included where they have one (kg m^2/s). Plane bodies only.
double angular_momentum(const Simulation& simulation);

}  // namespace hibi
