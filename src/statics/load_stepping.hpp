#pragma once
#include <optional>

#include "breaking/breaking.hpp"
#include "physics/mover.hpp"
#include "physics/physics.hpp"
#include "statics/equilibrium.hpp"

namespace hibi {

/// From equilibrium to equilibrium, load step by load step. A bond breaks at the end of a step, as in a motion
/// in time: what is recorded is the state in which it does.
template <int Dim>
class LoadStepping final : public Mover<Dim> {
 public:
    /// Brings `state`, an initial one, to equilibrium under what acts at t = 0. Throws std::runtime_error
    /// where a part of the model can move freely.
    LoadStepping(const Model<Dim>& model, const Physics& physics, Interactions<Dim>& interactions,
                 State<Dim>& state);

    void step(State<Dim>& state) override;
    double time_step() const override { return physics_.statics->step(); }
    std::vector<std::string> stage_names() const override;
    void rebuild(const State<Dim>& state) override;
    int factorisations() const override { return equilibrium_->factorisations(); }

 private:
    enum class Search {
        any_equilibrium,
        stable_equilibrium,
        next_break  ///< down the energy, until a bond is beyond its limit
    };
    void start(State<Dim>& state);
    void raise_loads(State<Dim>& state);
    void relax(State<Dim>& state);
    void pause(State<Dim>& state) const;
    Settled approach(State<Dim>& state, double to);
    Settled settle(State<Dim>& state, double load_time, Search search, double share = 1);
    void go_back_to(State<Dim>& state, const State<Dim>& earlier);
    void count_work(const State<Dim>& before, State<Dim>& now, bool smooth);
    int senseless_bond(const State<Dim>& state) const;
    void remember(State<Dim>& state);

    std::string collapse_message(const State<Dim>& state, const std::string& when, const Settled& settled,
                                 const std::string& way_out) const;
    void note_instability(State<Dim>& state, const Settled::Unstable& unstable, double from, double to,
                          double share) const;
    std::string place_text(int particle) const;

    // first_break.cpp
    void find_first_break(State<Dim>& state, const State<Dim>& before, double lower, double upper);
    void go_back_to_next_break(State<Dim>& state);
    double utilisation(const State<Dim>& state, int bond) const;
    double highest_utilisation(const State<Dim>& state) const;
    void break_overstrained(State<Dim>& state);

    double& load_time(State<Dim>& state) const { return state.memory(load_time_)[0]; }
    double load_time(const State<Dim>& state) const { return state.memory(load_time_)[0]; }
    double& settled(State<Dim>& state) const { return state.memory(settled_)[0]; }
    bool is_fragment(const State<Dim>& state, int i) const { return state.memory(fragment_)[i] != 0; }

    const Model<Dim>& model_;
    const Physics& physics_;
    Interactions<Dim>& interactions_;
    Breaking<Dim>* breaking_;  ///< null where nothing can break
    std::optional<Equilibrium<Dim>> equilibrium_;
    // Memories.
    int load_time_ = 0;  ///< for which the loads stand (s)
    int settled_ = 0;    ///< has no bond broken since equilibrium was found?
    int fragment_ = 0;   ///< particles that nothing ties to a support any more
    int buckled_ = 0;    ///< does the noted instability stand: was a stable equilibrium reached from there?
    int flags_ = 0, factor_displacement_ = 0, factor_intact_ = 0, stiffness_ = 0, softest_ = 0,
        softest_image_ = 0;  ///< of Equilibrium::Memory
    bool smooth_ = true;     ///< see Settled, of this step
};

}  // namespace hibi
