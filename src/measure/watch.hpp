#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "measure/cracks.hpp"
#include "physics/simulation.hpp"
#include "results/history.hpp"
#include "results/moment.hpp"
#include "results/snapshot.hpp"

namespace hibi {

/// Keeps one path of intact bonds from a held to a loaded particle; only when a bond of that path breaks is
/// another one looked for. Exact at every step, and nearly free.
class Connection {
 public:
    /// Without a path to begin with, an empty list say, there is nothing that could be lost.
    Connection(const std::vector<int>& from, const std::vector<int>& to, const Bonds& bonds);

    bool existed() const { return existed_; }
    /// Is there still a path? `just_broken` are the bonds broken since the last call.
    bool holds(const Bonds& bonds, std::span<const int> just_broken);

 private:
    bool search(const Bonds& bonds);

    std::vector<char> from_, to_;
    bool existed_ = false, lost_ = false;
    std::vector<char> on_path_;  ///< per bond
};

/// Watches a simulation from step to step: events, breaks, rows of the history. Changes nothing in it.
template <int Dim>
class Watch {
 public:
    explicit Watch(const Simulation<Dim>& simulation);

    /// After every step. A peak of the load is confirmed by a fall of a fifth, where bonds can break only
    /// after the first has: an elastic wave is no peak.
    void look();
    /// Does the energy balance say something yet? In its first 100 steps any run is off by about 1 / steps^2
    /// of next to no energy, the start of the trapezoidal sum over a ramp; unless bonds break already. A
    /// static run has no such start.
    bool settled() const;

    const Events& events() const { return events_; }
    /// Is there, before the run, a path of bonds from a held to a primary-loaded particle? What is loaded and
    /// held at once, a roller say, does not count as held.
    bool can_separate() const { return connection_.existed(); }
    bool peak_confirmed() const { return peak_confirmed_; }  ///< see look()
    const std::vector<Break>& just_broken() const { return just_broken_; }
    /// The current row; also brings the energy balance up to date.
    HistoryRow row();
    double worst_imbalance() const { return settled() ? worst_ : last_; }
    double imbalance_before_first_break() const { return worst_before_break_; }
    CrackReading crack() const { return cracks_.read(simulation_.time()); }
    double top_crack_speed() const { return cracks_.top_speed(); }  ///< so far (m/s)
    /// Counted anew only where bonds broke since the last call.
    const Fragments& fragments();
    int primary() const { return primary_; }  ///< index of the load that drives curve and events, or -1

 private:
    const Simulation<Dim>& simulation_;
    int primary_ = -1;
    Connection connection_;
    Events events_;
    Cracks<Dim> cracks_;
    Fragments fragments_;
    bool fragments_known_ = false;  ///< as the bonds are now
    bool peak_confirmed_ = false;
    std::vector<Break> just_broken_;
    double scale_ = 0, worst_ = 0, worst_before_break_ = 0, last_ = 0;
};

extern template class Watch<2>;

/// Positions, velocities and broken bonds as they are now, with everything derived from them.
template <int Dim>
Snapshot take_snapshot(const Simulation<Dim>& simulation);

extern template Snapshot take_snapshot<2>(const Simulation<2>&);

/// What a snapshot is derived from. Copying it takes far less time than deriving a snapshot.
template <int Dim>
struct Motion {
    double time = 0;  ///< (s)
    std::int64_t step = 0;
    std::vector<Vec<Dim>> displacement, velocity;  ///< (m), (m/s)
    std::vector<double> angle;                     ///< thesis variant only, else empty (rad)
};
template <int Dim>
Motion<Dim> copy_motion(const Simulation<Dim>& simulation);

extern template Motion<2> copy_motion<2>(const Simulation<2>&);

/// The body of a simulation as it was before anything broke: gives the snapshots of moments that have passed.
template <int Dim>
class UnbrokenBody {
 public:
    explicit UnbrokenBody(const Simulation<Dim>& simulation);
    /// The same bits as take_snapshot would have given then, if no bond was broken yet.
    Snapshot snapshot(Motion<Dim> motion);

 private:
    Model<Dim> model_;
    std::unique_ptr<ElasticLaw<Dim>> law_;
};

extern template class UnbrokenBody<2>;

}  // namespace hibi
