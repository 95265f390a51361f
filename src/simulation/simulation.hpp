#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/stage_time.hpp"
#include "breaking/breaking.hpp"
#include "loads/supports.hpp"
#include "physics/interaction.hpp"
#include "physics/mover.hpp"
#include "physics/physics.hpp"

namespace hibi {

struct LoadReading {
    double load = 0;  ///< applied total along Load::direction, or the reaction of driven particles (N)
    double displacement =
        0;  ///< mean over the particles, of a face over its outermost, along Load::direction (m)
};

/// A run, as commands and recorder see it: whatever the dimension, and whatever way it moves.
class Simulation {
 public:
    virtual ~Simulation() = default;

    virtual void step() = 0;

    virtual int dimension() const = 0;
    virtual const Physics& physics() const = 0;
    virtual int particle_count() const = 0;
    virtual int bond_count() const = 0;
    /// Smaller side of a body over its spacing; of several bodies the least [-].
    virtual double narrowest_in_spacings() const = 0;

    virtual double time() const = 0;
    virtual std::int64_t steps() const = 0;
    virtual double time_step() const = 0;         ///< in statics the load step (s)
    virtual double stable_time_step() const = 0;  ///< 2 / highest frequency (s); 0 in statics
    virtual double damping_rate() const = 0;      ///< c (1/s); 0 when undamped

    virtual int broken() const = 0;
    virtual bool can_break() const = 0;
    /// Largest bond strain over its limit [-]; 0 where nothing can break.
    virtual double closest_to_breaking() const = 0;

    virtual Energies energies() const = 0;
    virtual Vec3 momentum() const = 0;
    virtual LoadReading read(int load) const = 0;

    virtual void stop_damping() = 0;
    virtual void release(int load) = 0;  ///< its force ends, or its particles move freely from now on

    /// Set when a number stopped being finite: step, time, particle and likely cause. The state is that of
    /// the failure.
    virtual std::optional<std::string> failure() const = 0;
    /// Statics only: set when no equilibrium is found beyond the current load, and says where the body gives
    /// way and, before the first break, what to try. The state is the last equilibrium; further steps change
    /// nothing.
    virtual std::optional<std::string> collapse() const = 0;
    /// Statics only: says when, under which load and where an equilibrium became unstable, before the first
    /// break; the first time. The body was then led on to a stable one.
    virtual std::optional<std::string> instability() const = 0;
    /// Why a run at this state is likely to have gone wrong, for messages.
    virtual std::string likely_cause() const = 0;
    /// The particle that moves fastest, for messages: where a run goes wrong.
    virtual std::string fastest_particle() const = 0;

    /// The stages of a step in order, as `check` shows them.
    virtual std::vector<std::string> stage_names() const = 0;
    /// From now on the times of the stages are added to `times`; null: they are not taken.
    virtual void profile(StageTimes* times) = 0;
};

/// Makes an interaction that the physics does not know of.
template <int Dim>
using MakeInteraction =
    std::function<std::unique_ptr<Interaction<Dim>>(const Model<Dim>&, const Physics&, State<Dim>&)>;

/// Owns the model and its State, the list of what acts on it, and the way it moves.
template <int Dim>
class SimulationIn final : public Simulation {
 public:
    /// Throws std::runtime_error where the physics does not fit the model (a damping ratio, or statics, on a
    /// free body) or the prescribed time step is not stable. `more`: interactions beside those of the physics.
    SimulationIn(Model<Dim> model, Physics physics, const std::vector<MakeInteraction<Dim>>& more = {});
    SimulationIn(const SimulationIn&) = delete;  // its parts point to each other

    const Model<Dim>& model() const { return model_; }
    const State<Dim>& state() const { return state_; }
    /// Goes on from the state of another simulation of the same model and physics, to the last bit.
    void go_on_from(State<Dim> state);

    /// Bonds that broke in the last step, in rising order, and the strain at which each did.
    std::span<const int> just_broken() const;
    std::span<const double> breaking_strains() const;
    double kinetic_energy() const { return state_.energies.kinetic; }
    /// Of particles [begin, end), a block of parallel_for's.
    std::vector<LocalState<Dim>> local(int begin, int end) const {
        return interactions_.elastic().law().local(state_, begin, end);
    }
    /// Particles held or driven in some direction.
    HeldComponents held() const;
    /// Statics only: how many factors of a tangent were tried, which is what time goes into.
    int factorisations() const { return mover_->factorisations(); }

    void step() override { mover_->step(state_); }
    int dimension() const override { return Dim; }
    const Physics& physics() const override { return physics_; }
    int particle_count() const override { return model_.particles.count(); }
    int bond_count() const override { return model_.bonds.count(); }
    double narrowest_in_spacings() const override;
    double time() const override { return state_.time; }
    std::int64_t steps() const override { return state_.step; }
    double time_step() const override { return mover_->time_step(); }
    double stable_time_step() const override { return mover_->stable_time_step(); }
    double damping_rate() const override { return state_.damping_rate; }
    int broken() const override { return state_.broken; }
    bool can_break() const override { return breaking_ != nullptr; }
    double closest_to_breaking() const override;
    Energies energies() const override { return interactions_.energies(state_); }
    Vec3 momentum() const override;
    LoadReading read(int load) const override;
    void stop_damping() override { state_.damping_rate = 0; }
    void release(int load) override;
    std::optional<std::string> failure() const override { return text(state_.failure); }
    std::optional<std::string> collapse() const override { return text(state_.collapse); }
    std::optional<std::string> instability() const override { return text(state_.instability); }
    std::string likely_cause() const override { return hibi::likely_cause(model_, state_, *mover_); }
    std::string fastest_particle() const override;
    std::vector<std::string> stage_names() const override { return mover_->stage_names(); }
    void profile(StageTimes* times) override { mover_->profile(times); }

 private:
    static std::optional<std::string> text(const std::string& text) {
        return text.empty() ? std::nullopt : std::optional(text);
    }

    const Model<Dim> model_;
    const Physics physics_;
    State<Dim> state_;
    Interactions<Dim> interactions_;
    Breaking<Dim>* breaking_ = nullptr;  ///< one of the interactions, where something can break
    std::unique_ptr<Mover<Dim>> mover_;
};

extern template class SimulationIn<2>;

/// Calls visit(simulation) with the simulation in its dimension.
template <class Visit>
decltype(auto) in_its_dimension(const Simulation& simulation, Visit&& visit) {
    return visit(static_cast<const SimulationIn<2>&>(simulation));
}

}  // namespace hibi
