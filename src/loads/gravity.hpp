#pragma once
#include "physics/interaction.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// Weight in a uniform field.
template <int Dim>
class Weight final : public Interaction<Dim> {
 public:
    Weight(const Model<Dim>& model, const Gravity& gravity)
        : model_(model), g_(gravity.acceleration.template head<Dim>()) {}

    StageNames stages() const override { return {.forces = "gravity"}; }
    void add_forces(State<Dim>& state, int begin, int end) const override;
    void add_static_loads(const State<Dim>& state, double time, double share,
                          StaticLoads<Dim>& loads) const override;
    /// Its work is known from the displacements.
    void add_energies(const State<Dim>& state, Energies& energies) const override;

 private:
    const Model<Dim>& model_;
    Vec<Dim> g_;  ///< (m/s^2)
};

}  // namespace hibi
