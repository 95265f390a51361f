#pragma once
#include <string>
#include <vector>

#include "base/stage_time.hpp"
#include "model/state.hpp"

namespace hibi {

/// A way of going from one state to the next: in time, or from equilibrium to equilibrium. None knows of
/// another.
template <int Dim>
class Mover {
 public:
    virtual ~Mover() = default;

    /// One step. Where it cannot go on it says so in the State.
    virtual void step(State<Dim>& state) = 0;
    virtual double time_step() const = 0;                   ///< in statics the load step (s)
    virtual double stable_time_step() const { return 0; }  ///< 2 / highest frequency (s); 0: there is no limit
    /// The stages of a step in order, as `check` shows them.
    virtual std::vector<std::string> stage_names() const = 0;
    /// Rebuilds what follows from the State, which another simulation has brought about.
    virtual void rebuild(const State<Dim>& state) = 0;
    /// A load has ended: what it drove may move.
    virtual void let_go(const State<Dim>&) {}
    /// How many factors of a tangent were tried, which is what the time of statics goes into.
    virtual int factorisations() const { return 0; }

    /// From now on the times of the stages are added to `times`; null: they are not taken.
    void profile(StageTimes* times) { profile_ = times; }

 protected:
    StageTimes* profile_ = nullptr;
};

/// Why a run at this state is likely to have gone wrong, for messages.
template <int Dim>
std::string likely_cause(const Model<Dim>& model, const State<Dim>& state, const Mover<Dim>& mover);

}  // namespace hibi
