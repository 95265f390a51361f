#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/stage_time.hpp"
#include "model/model.hpp"
#include "physics/elastic.hpp"
#include "physics/equilibrium.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// All at one time, positions and velocities in step (J).
struct Energies {
    double kinetic = 0, elastic = 0, contact = 0;
    double damped = 0;  ///< taken out by damping so far; in statics what is lost on the way to equilibrium
    double released =
        0;  ///< elastic energy of bonds at the moment they broke; a single break may be slightly negative
    double work =
        0;  ///< done by loads, prescribed motion and gravity so far, plus the initial kinetic energy
    double sum() const { return kinetic + elastic + contact + damped + released; }
};

struct LoadReading {
    double load = 0;  ///< applied total along Load::direction, or the reaction of driven particles (N)
    double displacement =
        0;  ///< mean over the particles, of a face over its outermost, along Load::direction (m)
};

/// A run that cannot go on.
struct Failure {
    std::int64_t step = 0;
    double time = 0;
    int particle = -1;
    std::string message;  ///< step, time, particle, likely cause
};

/// Owns the model and moves it in time by velocity Verlet, or from equilibrium to equilibrium where the
/// physics has statics. A step is the list of stages that the physics asks for.
template <int Dim>
class Simulation {
 public:
    /// Throws std::runtime_error where the physics does not fit the model (a damping ratio, or statics, on a
    /// free body) or the prescribed time step is not stable.
    Simulation(Model<Dim> model, Physics physics);
    Simulation(const Simulation&) = delete;  // its stages point to it

    void step();

    double time() const { return time_; }
    double time_step() const { return time_step_; }  ///< in statics the load step (s)
    double stable_time_step() const {
        return stable_time_step_;
    }                                                      ///< 2 / highest frequency (s); 0 in statics
    double damping_rate() const { return damping_rate_; }  ///< c (1/s); 0 when undamped
    std::int64_t steps() const { return steps_; }
    const Model<Dim>& model() const { return model_; }
    const Physics& physics() const { return physics_; }

    /// Bonds that broke in the last step, in rising order, and the strain at which each did.
    std::span<const int> just_broken() const { return just_broken_; }
    std::span<const double> breaking_strains() const { return breaking_strains_; }
    int broken() const { return broken_; }
    bool can_break() const { return !limits_.upper.empty(); }

    Energies energies() const;
    double kinetic_energy() const { return kinetic_; }
    Vec<Dim> momentum() const;
    LoadReading read(int load) const;
    /// Of particles [begin, end), a block of parallel_for's.
    std::vector<LocalState<Dim>> local(int begin, int end) const { return law_->local(model_, begin, end); }
    /// Particles held or driven in some direction.
    const std::vector<std::array<bool, 3>>& held() const { return held_; }

    void stop_damping() { damping_rate_ = 0; }
    void release(int load);  ///< its force ends, or its particles move freely from now on

    /// Set when a number stopped being finite; the state is that of the failure.
    const std::optional<Failure>& failure() const { return failure_; }
    /// Largest bond strain over its limit [-]; 0 where nothing can break.
    double closest_to_breaking() const;
    /// Statics only: set when no equilibrium is found beyond the current load, and says where the body gives
    /// way and, before the first break, what to try. The state is the last equilibrium; further steps change
    /// nothing.
    const std::optional<std::string>& collapse() const { return collapse_; }
    /// Statics only: says when, under which load and where an equilibrium became unstable, before the first
    /// break; the first time. The body was then led on to a stable one.
    const std::optional<std::string>& instability() const { return instability_; }
    /// Statics only: how many factors of a tangent were tried, which is what time goes into.
    int factorisations() const { return equilibrium_ ? equilibrium_->factorisations() : 0; }
    /// Why a run at this state is likely to have gone wrong, for messages.
    std::string likely_cause() const;

    /// The stages of a step in order, as `check` shows them.
    std::vector<std::string> stage_names() const;
    /// From now on the times of the stages are added to `times`; null: they are not taken.
    void profile(StageTimes* times) { profile_ = times; }

 private:
    struct LoadState {
        bool released = false;
        std::vector<Vec<Dim>> force;  ///< applied force on its particles now (N)
    };
    /// A particle component moved by a load.
    struct Driven {
        int load = 0, particle = 0, axis = 0;
        double displacement = 0, velocity = 0;  ///< now (m), (m/s)
        double moved = 0, old_force = 0;        ///< in this step (m); total force before it (N)
    };

    /// What a load step starts from.
    struct StaticState {
        std::vector<Vec<Dim>> displacement;
        std::vector<LoadState> loads;
        std::vector<Driven> driven;
        Energies energies;
        double load_time = 0;
    };

    /// Named part of an explicit step.
    struct Stage {
        std::string name;
        std::function<void()> run;
    };
    void list_stages();
    void explicit_step();
    void choose_time_step(bool can_break);
    void turn_with_neighbours();
    void prepare_blocks();
    double kick(int begin, int end);
    double kinetic_energy_of(int begin, int end) const;
    void kick_and_drift();
    void prescribe_motion();
    void list_applied_forces();
    void update_loads(double step);
    void add_applied_forces(int begin, int end);
    void sum_forces();
    void sum_forces_and_kick();
    void finish_motion();
    void judge_and_break();
    void break_bonds();
    void report_failure();
    Vec<Dim> applied_force(const Load& load, std::size_t k, double time) const;

    // static_step.cpp
    void start_statics();
    void static_step();
    std::vector<std::string> static_stage_names() const;
    void relax();
    std::string collapse_message(const std::string& when, const Settled& settled,
                                 const std::string& way_out) const;
    void note_instability(const Settled::Unstable& unstable, double from, double to, double share);
    std::string place_text(int particle) const;
    int senseless_bond() const;
    void raise_loads();
    void pause();
    Settled approach(double to);
    enum class Search {
        any_equilibrium,
        stable_equilibrium,
        next_break  ///< down the energy, until a bond is beyond its limit
    };
    Settled settle(double load_time, Search search, double share = 1);
    StaticState static_state() const;
    void restore(const StaticState& state);
    void count_work(const StaticState& before, bool smooth);

    // static_break.cpp
    void find_first_break(const StaticState& before, double lower, double upper);
    void go_back_to_next_break();
    double utilisation(int bond) const;
    double highest_utilisation() const;
    void break_overstrained();

    Vec3 place(int particle) const { return to_3d<Dim>(model_.particles.reference_position[particle]); }

    Model<Dim> model_;
    Physics physics_;
    std::unique_ptr<ElasticLaw<Dim>> law_;
    BreakLimits limits_;  ///< at which each bond breaks; empty: nothing can break
    std::vector<std::array<bool, 3>> held_;
    std::vector<Vec<Dim>> inverse_mass_;   ///< per component; 0 where held or driven (1/kg)
    std::vector<double> inverse_inertia_;  ///< thesis variant; 0 where held
    std::vector<LoadState> loads_;
    std::vector<Driven> driven_;
    /// Which applied forces act in which block of particles: those of block b at applied_start_[b] and on.
    struct Applied {
        int particle = 0, load = 0, place = 0;  ///< loads_[load].force[place]
    };
    std::vector<Applied> applied_;
    std::vector<int> applied_start_;
    std::vector<double> damped_in_block_, kinetic_in_block_;  ///< in the last kick (J)
    std::vector<double> inverse_mass_of_block_;  ///< where all its components have the same; else 0 (1/kg)
    std::vector<Stage> stages_;
    StageTimes* profile_ = nullptr;
    double stable_time_step_ = 0, time_step_ = 0, damping_rate_ = 0;
    double time_ = 0;
    std::int64_t steps_ = 0;
    std::vector<int> suspects_;  ///< blocks of particles in which bonds may be beyond their limits
    int broken_ = 0;
    double kinetic_ = 0, damped_ = 0, released_ = 0, work_ = 0;
    std::vector<int> just_broken_;
    std::vector<double> breaking_strains_;
    std::optional<Failure> failure_;

    std::optional<Equilibrium<Dim>> equilibrium_;  ///< statics only, as all below
    double load_time_ = 0;                         ///< for which the loads stand (s)
    bool settled_ = true;                          ///< no bond has broken since equilibrium was found
    bool smooth_ = true;                           ///< see Settled, of the last step
    std::vector<char> fragment_;                   ///< particles that nothing ties to a support
    std::optional<std::string> collapse_, instability_;
    bool buckled_ = false;  ///< instability_ stands: from there a stable equilibrium was reached
};

extern template class Simulation<2>;

}  // namespace hibi
