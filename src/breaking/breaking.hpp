#pragma once
#include <span>

#include "physics/interaction.hpp"

namespace hibi {

/// Breaks bonds that are beyond their limits, for good.
template <int Dim>
class Breaking final : public Interaction<Dim> {
 public:
    /// Of the bonds of `interactions`, to which it will belong.
    Breaking(const Model<Dim>& model, Interactions<Dim>& interactions)
        : model_(model), interactions_(interactions) {}

    StageNames stages() const override {
        return {.forces = "watch limits", .end = "judge and break bonds"};
    }
    /// The energy balance through breaks needs the smaller step.
    double time_step_factor() const override { return 0.5; }
    /// All bonds are judged on the same state and then broken, so the result does not depend on their order.
    /// What breaks is released at unchanged positions, after the whole step: the energy balance stays an order
    /// of magnitude better than with a break between drift and kick.
    void end_step(State<Dim>& state) override;

    /// Breaks these bonds (rising); the displacements stay. The forces are not summed anew.
    void break_bonds(State<Dim>& state, std::vector<int> bonds);
    /// Forgets those of the last step.
    void begin_step(State<Dim>&) override;

    /// Bonds that broke in the last step, in rising order, and the strain at which each did.
    std::span<const int> just_broken() const { return just_broken_; }
    std::span<const double> breaking_strains() const { return breaking_strains_; }

    /// Growth of L^2 over its limit: above 1 the bond breaks.
    double utilisation(const State<Dim>& state, int bond) const;
    /// Largest bond strain over its limit [-].
    double closest_to_breaking(const State<Dim>& state) const;

 private:
    Vec<Dim> stretch(const State<Dim>& state, int bond) const {
        return state.displacement[model_.bonds.second[bond]] - state.displacement[model_.bonds.first[bond]];
    }

    const Model<Dim>& model_;
    Interactions<Dim>& interactions_;
    std::vector<int> just_broken_;
    std::vector<double> breaking_strains_;
};

}  // namespace hibi
