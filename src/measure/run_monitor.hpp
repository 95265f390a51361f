#pragma once
#include <memory>
#include <string>
#include <vector>

#include "results/history.hpp"
#include "results/moment.hpp"
#include "simulation/simulation.hpp"

namespace hibi {

/// Watches a simulation from step to step: events, breaks, rows of the history. Changes nothing in it.
class RunMonitor {
 public:
    virtual ~RunMonitor() = default;

    /// After every step. A peak of the load is confirmed by a fall of a fifth, where bonds can break only
    /// after the first has: an elastic wave is no peak.
    virtual void look() = 0;
    /// Does the energy balance say something yet? In its first 100 steps any run is off by about 1 / steps^2
    /// of next to no energy, the start of the trapezoidal sum over a ramp; unless bonds break already. A
    /// static run has no such start.
    virtual bool settled() const = 0;
    /// Is there, before the run, a path of bonds from a held to a primary-loaded particle? What is loaded and
    /// held at once, a roller say, does not count as held.
    virtual bool can_separate() const = 0;
    /// The current row; also brings the energy balance up to date.
    virtual HistoryRow row() = 0;
    virtual CrackReading crack() const = 0;
    virtual double top_crack_speed() const = 0;  ///< so far (m/s)
    /// Counted anew only where bonds broke since the last call.
    virtual const Fragments& fragments() = 0;

    const Events& events() const { return events_; }
    bool peak_confirmed() const { return peak_confirmed_; }  ///< see look()
    const std::vector<Break>& just_broken() const { return just_broken_; }
    double worst_imbalance() const { return settled() ? worst_ : last_; }
    double imbalance_before_first_break() const { return worst_before_break_; }
    int primary() const { return primary_; }  ///< index of the load that drives curve and events, or -1

    /// Everything that a look reads and an earlier one has changed; and going on from there, with the
    /// simulation in the state that it had then.
    virtual std::string state() const = 0;
    virtual void go_on_from(const std::string& state) = 0;

 protected:
    int primary_ = -1;
    Events events_;
    bool peak_confirmed_ = false;
    std::vector<Break> just_broken_;
    double scale_ = 0, worst_ = 0, worst_before_break_ = 0, last_ = 0;
};

/// The simulation must outlive it.
std::unique_ptr<RunMonitor> make_run_monitor(const Simulation& simulation);

}  // namespace hibi
