#pragma once
#include <vector>

#include "base/vec.hpp"

namespace hibi {

/// What never changes of the particles, one entry per particle in every array. SI units throughout. Dim is 2
/// or 3. What a step changes is in State.
template <int Dim>
struct Particles {
    std::vector<Vec<Dim>> reference_position;  ///< X, in the unloaded body (m)
    std::vector<Vec<Dim>> initial_velocity;    ///< v at the start (m/s)
    std::vector<double> mass;                  ///< (kg)
    std::vector<double> volume;                ///< spacing^Dim, times the thickness in 2-D (m^3)
    std::vector<double> spacing;               ///< l0 of its body (m)
    std::vector<int> material;                 ///< index into Model::materials
    std::vector<int> body;                     ///< index into Model::bodies

    /// The one list of fields. Resize and hash walk it, so a new field is one line.
    template <class Self, class Visit>
    static void each_field(Self& self, Visit&& visit) {
        visit("reference_position", self.reference_position);
        visit("initial_velocity", self.initial_velocity);
        visit("mass", self.mass);
        visit("volume", self.volume);
        visit("spacing", self.spacing);
        visit("material", self.material);
        visit("body", self.body);
    }

    int count() const { return static_cast<int>(reference_position.size()); }
};

}  // namespace hibi
