#pragma once
#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "base/stage_time.hpp"
#include "measure/run_monitor.hpp"
#include "measure/snapshots.hpp"
#include "record/run_folder.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// States at even intervals when it is not known how long the run will last: once there are more than `most`,
/// every second one is dropped and the interval doubles. What is left is even, and between most / 2 and most.
class EvenStates {
 public:
    EvenStates(double begin, double interval, std::size_t most)
        : next_(begin), interval_(interval), most_(most) {}

    bool due(double time) const { return time >= next_; }
    double interval() const { return interval_; }
    /// Notes that the state of `step` was kept; returns the steps to be dropped.
    std::vector<std::int64_t> keep(double time, std::int64_t step);

 private:
    double next_, interval_;
    std::size_t most_;
    std::vector<std::int64_t> kept_;
};

/// Decides when a row or a state is due and hands it to the writer: states evenly over the run, densely from
/// first break until well after separation and in slow spans known beforehand, and from a ring in memory for
/// the moments before first break.
class Recorder {
 public:
    /// References are kept. The first state and row are recorded at once.
    Recorder(const Scene& scene, const Simulation& simulation, RunMonitor& monitor, RunWriter& writer,
             StageTimes* profile = nullptr);

    /// After every step, when the monitor has looked.
    void look();
    /// The last state and row, and what the ring still holds; of a state that is no longer finite only the
    /// latter.
    void finish();
    /// Imbalance of the last row [-]; not finite where an energy is not: such a row is not recorded.
    double imbalance() const { return imbalance_; }
    /// Largest strain, in size, of an intact bond in the recorded states [-].
    double largest_strain() const { return largest_strain_; }

 private:
    bool wanted_already(std::int64_t step);
    void write_now();
    void write_row();
    void write_ring();
    double first_even_interval(const Scene& scene) const;
    void keep(EvenStates& series);
    void write_state(Snapshot state);

    const Simulation& simulation_;
    RunMonitor& monitor_;
    RunWriter& writer_;
    StageTimes* profile_;
    std::map<std::int64_t, int> wanted_;  ///< by how many reasons the state of a step is kept
    std::int64_t last_written_ = -1;
    double last_row_ = 0, imbalance_ = 0, largest_strain_ = 0;
    /// What rows and states are counted in: the time step (s). A static run has few and dear steps, of which
    /// none should be missed: a part of the shortest.
    double tick_ = 0;
    /// In a shorter time nothing is seen to move (s): a large body takes many steps to change. 0 in statics.
    double unseen_ = 0;
    std::size_t even_most_ = 0;
    EvenStates even_;
    double failure_interval_ = 0;  ///< (s)
    std::size_t failure_most_ = 0;
    std::optional<EvenStates> failure_;  ///< from first break on
    double failure_end_ = std::numeric_limits<double>::infinity();
    struct Span {
        double begin, end;
        EvenStates states;
    };
    std::vector<Span> spans_;  ///< slow motion at times known beforehand
    double last_ring_ = 0;
    std::deque<Motion> ring_;  ///< of recent moments, until first break
    bool separation_kept_ = false;
};

}  // namespace hibi
