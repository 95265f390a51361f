#pragma once
#include <optional>
#include <vector>

#include "measure/history.hpp"
#include "measure/moment.hpp"
#include "measure/snapshot.hpp"
#include "physics/simulation.hpp"

namespace hibi {

/// Keeps one path of intact bonds from a held to a loaded particle; only when a bond of that path breaks is
/// another one looked for. Exact at every step, and nearly free.
class Connection {
 public:
    /// Both lists may share particles; an empty one means that the question cannot be asked.
    Connection(const std::vector<int>& from, const std::vector<int>& to, int particles);

    bool can_be_asked() const { return asked_; }
    /// Is there still a path? `just_broken` are the bonds broken since the last call.
    bool holds(const Bonds& bonds, std::span<const int> just_broken);

 private:
    bool search(const Bonds& bonds);

    std::vector<char> from_, to_;
    bool asked_ = false, found_ = false, lost_ = false;
    std::vector<char> on_path_;  ///< per bond
};

/// Watches a simulation from step to step: events, breaks, rows of the history. Changes nothing in it.
template <int Dim>
class Watch {
 public:
    explicit Watch(const Simulation<Dim>& simulation);

    /// After every step.
    void look();

    const Events& events() const { return events_; }
    bool peak_confirmed() const {
        return peak_confirmed_;
    }  ///< the load has fallen by a fifth since its peak
    const std::vector<Break>& just_broken() const { return just_broken_; }
    /// The current row; also brings the energy balance up to date.
    HistoryRow row();
    double worst_imbalance() const { return worst_; }
    double imbalance_before_first_break() const { return worst_before_break_; }
    int primary() const { return primary_; }  ///< index of the load that drives curve and events, or -1

 private:
    const Simulation<Dim>& simulation_;
    int primary_ = -1;
    Connection connection_;
    Events events_;
    bool peak_confirmed_ = false;
    std::vector<Break> just_broken_;
    double scale_ = 0, worst_ = 0, worst_before_break_ = 0;
};

extern template class Watch<2>;

/// Positions, velocities and broken bonds as they are now, with everything derived from them.
template <int Dim>
Snapshot take_snapshot(const Simulation<Dim>& simulation);

extern template Snapshot take_snapshot<2>(const Simulation<2>&);

}  // namespace hibi
