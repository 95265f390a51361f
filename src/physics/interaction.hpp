#pragma once
#include <memory>
#include <string>
#include <vector>

#include "elasticity/elastic_law.hpp"
#include "model/state.hpp"

namespace hibi {

/// What an interaction calls its parts of a step in time, as `check` shows them; empty: it has no such part.
struct StageNames {
    std::string move{};    ///< a stage of its own, between the drift and the forces
    std::string forces{};  ///< what it does within the stage of the forces
    std::string end{};     ///< a stage of its own, at the end of the step
};

/// Dead loads and prescribed motion of a search for static equilibrium, per particle.
template <int Dim>
struct StaticLoads {
    std::vector<Vec<Dim>> applied;  ///< (N)
    std::vector<Vec<Dim>> moved;    ///< by how much held components move on the way (m)
};

/// Something that acts on the particles. A simulation holds a list of them and knows no more of each than
/// this. What it keeps from step to step lies in the State: it adds its memories there when it is made.
/// Everything else that it holds follows from the model, the physics and the State.
template <int Dim>
class Interaction {
 public:
    virtual ~Interaction() = default;

    virtual StageNames stages() const { return {}; }

    // What it asks of the time step.

    /// Bound on what it adds to the square of the highest angular frequency (1/s^2).
    virtual double squared_frequency() { return 0; }
    /// Part of the stable time step that keeps the energy balance.
    virtual double time_step_factor() const { return 0.8; }

    // A step in time, in this order; see VelocityVerlet.

    /// Sets what it prescribes at t = 0.
    virtual void start(State<Dim>&) {}
    /// Before anything moves.
    virtual void begin_step(State<Dim>&) {}
    /// After the drift; the time is that of the end of the step, of `step` seconds.
    virtual void move(State<Dim>&, double /*step*/) {}
    /// Adds its forces on particles [begin, end), a block of parallel_for's, and writes to no other. Called
    /// from several threads.
    virtual void add_forces(State<Dim>&, int /*begin*/, int /*end*/) const {}
    /// When all forces stand and all velocities are those of the end of the step.
    virtual void finish_motion(State<Dim>&) {}
    virtual void end_step(State<Dim>&) {}

    // Statics.

    /// Adds a share of its loads at that time.
    virtual void add_static_loads(const State<Dim>&, double /*time*/, double /*share*/,
                                  StaticLoads<Dim>&) const {}
    /// An equilibrium under these loads has been found.
    virtual void take_static_loads(State<Dim>&, double /*time*/, double /*share*/) {}
    /// Adds its work on the way between two equilibria, by the trapezoidal rule, to the account of `now`.
    virtual void add_static_work(const State<Dim>& /*before*/, State<Dim>& /*now*/) const {}

    // Both.

    /// Adds what it can tell of the energies at any moment; most is on the accounts of the State already.
    virtual void add_energies(const State<Dim>&, Energies&) const {}
    /// Force of a load along its direction, if it is one of its own (N).
    virtual double load(const State<Dim>&, int /*load*/) const { return 0; }
    /// That load ends.
    virtual void release(State<Dim>&, int /*load*/) {}
    /// Rebuilds what follows from the State, which another simulation has brought about.
    virtual void rebuild(const State<Dim>&) {}
};

/// The bonds of an elastic law: the first of the interactions. Its loop over the bonds is the hot one and
/// calls the others' add_forces for each block of particles while that is in the cache.
template <int Dim>
class ElasticForces final : public Interaction<Dim> {
 public:
    /// Without limits nothing is watched.
    ElasticForces(const Model<Dim>& model, Elasticity elasticity, BreakLimits limits);

    StageNames stages() const override;
    double squared_frequency() override;
    void add_energies(const State<Dim>& state, Energies& energies) const override;
    void rebuild(const State<Dim>& state) override;

    ElasticLaw<Dim>& law() { return *law_; }
    const ElasticLaw<Dim>& law() const { return *law_; }
    /// At which each bond breaks.
    const BreakLimits& limits() const { return limits_; }
    /// Blocks of particles, rising, in which bonds may be beyond their limits since the forces were summed.
    std::vector<int> suspects;

 private:
    const Model<Dim>& model_;
    Elasticity elasticity_;
    BreakLimits limits_;
    std::unique_ptr<ElasticLaw<Dim>> law_;
};

/// All that acts on a model, in the order in which it does.
template <int Dim>
class Interactions {
 public:
    explicit Interactions(std::unique_ptr<ElasticForces<Dim>> elastic);

    void add(std::unique_ptr<Interaction<Dim>> interaction) { list_.push_back(std::move(interaction)); }
    ElasticForces<Dim>& elastic() { return *elastic_; }
    const ElasticForces<Dim>& elastic() const { return *elastic_; }
    /// The one of that kind; null where there is none.
    template <class Kind>
    Kind* find() const {
        for (const auto& interaction : list_)
            if (auto* found = dynamic_cast<Kind*>(interaction.get())) return found;
        return nullptr;
    }
    auto begin() const { return list_.begin(); }
    auto end() const { return list_.end(); }

    /// All forces of the displacements that the law has been told of; `finish_block` as there.
    void sum_forces(State<Dim>& state, const FinishBlock& finish_block = {});
    /// The same for displacements that it has not been told of.
    void update_and_sum_forces(State<Dim>& state);
    /// Of some blocks of particles (rising), after bonds have been removed.
    void recompute_forces(State<Dim>& state, const std::vector<int>& blocks);
    Energies energies(const State<Dim>& state) const;

 private:
    void add_forces(State<Dim>& state, int begin, int end) const;

    ElasticForces<Dim>* elastic_;
    std::vector<std::unique_ptr<Interaction<Dim>>> list_;
};

}  // namespace hibi
