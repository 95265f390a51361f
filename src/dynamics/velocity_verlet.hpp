#pragma once
#include <functional>

#include "loads/supports.hpp"
#include "physics/interaction.hpp"
#include "physics/mover.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// Motion in time by velocity Verlet: half kick, drift, forces, half kick. A step is a list of stages; what is
/// absent from the physics is no stage.
template <int Dim>
class VelocityVerlet final : public Mover<Dim> {
 public:
    /// Brings `state`, an initial one, to t = 0. Throws std::runtime_error where the physics does not fit the
    /// model (a damping ratio on a free body) or the prescribed time step is not stable.
    VelocityVerlet(const Model<Dim>& model, const Physics& physics, Interactions<Dim>& interactions,
                   State<Dim>& state);
    VelocityVerlet(const VelocityVerlet&) = delete;  // its stages point to it

    void step(State<Dim>& state) override;
    double time_step() const override { return time_step_; }
    double stable_time_step() const override { return stable_time_step_; }
    std::vector<std::string> stage_names() const override;
    void rebuild(const State<Dim>& state) override;
    void let_go(const State<Dim>& state) override { rebuild(state); }

 private:
    struct Stage {
        std::string name;
        std::function<void(State<Dim>&)> run;
    };
    void list_stages(const State<Dim>& state);
    void choose_time_step();
    void kick_and_drift(State<Dim>& state);
    void sum_forces_and_kick(State<Dim>& state);
    double kick(State<Dim>& state, int begin, int end) const;
    double kinetic_energy_of(const State<Dim>& state, int begin, int end) const;
    void report_failure(State<Dim>& state) const;

    const Model<Dim>& model_;
    const Physics& physics_;
    Interactions<Dim>& interactions_;
    std::vector<Stage> stages_;
    double stable_time_step_ = 0, time_step_ = 0;
    std::vector<Vec<Dim>> inverse_mass_;         ///< per component; 0 where held or driven (1/kg)
    std::vector<double> inverse_mass_of_block_;  ///< where all its components have the same; else 0 (1/kg)
    std::vector<double> spin_inertia_, inverse_spin_inertia_;  ///< if particles have angles; 0 where held
    std::vector<double> damped_in_block_, kinetic_in_block_;   ///< in the last kick (J)
};

}  // namespace hibi
