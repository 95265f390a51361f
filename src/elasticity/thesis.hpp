#pragma once
#include <memory>

#include "elasticity/elastic_law.hpp"

namespace hibi {

// The variant of Ando's thesis, in the plane: each particle has an angle of its own.

/// The law; it uses the angles of a state, which must exist.
std::unique_ptr<ElasticLaw<2>> make_thesis_law(const Model<2>& model, const BreakLimits& limits);

/// Inertia of the angle of a particle, m l0^2 / 6 (kg m^2).
inline double spin_inertia(const Particles<2>& particles, int i) {
    return particles.mass[i] * particles.spacing[i] * particles.spacing[i] / 6;
}

}  // namespace hibi
