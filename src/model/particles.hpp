#pragma once
#include <vector>

#include "base/vec.hpp"

namespace hibi {

/// One entry per particle in every array. SI units throughout. Dim is 2 or 3.
/// The displacement, not the position, is the unknown: strains of 1e-9 then keep their digits.
template <int Dim>
struct Particles {
    std::vector<Vec<Dim>> reference_position;  ///< X, in the unloaded body (m)
    std::vector<Vec<Dim>> displacement;        ///< u = x - X (m)
    std::vector<Vec<Dim>> velocity;            ///< v (m/s)
    std::vector<Vec<Dim>> force;               ///< sum of all terms at the current time (N)
    std::vector<double> mass;                  ///< (kg)
    std::vector<double> volume;                ///< spacing^Dim, times the thickness in 2-D (m^3)
    std::vector<double> spacing;               ///< l0 of its body (m)
    std::vector<int> material;                 ///< index into Model::materials
    std::vector<int> body;                     ///< index into Model::bodies

    /// The one list of fields. Resize and hash walk it, so a new field is one line.
    template <class Self, class Visit>
    static void each_field(Self& self, Visit&& visit) {
        visit("reference_position", self.reference_position);
        visit("displacement", self.displacement);
        visit("velocity", self.velocity);
        visit("force", self.force);
        visit("mass", self.mass);
        visit("volume", self.volume);
        visit("spacing", self.spacing);
        visit("material", self.material);
        visit("body", self.body);
    }

    int count() const { return static_cast<int>(reference_position.size()); }
    Vec<Dim> position(int i) const { return reference_position[i] + displacement[i]; }
};

}  // namespace hibi
