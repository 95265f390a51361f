#include "solve/recorder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hibi {

namespace {

/// Nobody knows how long a run will last: rows come every few steps, and later in proportion to the time.
constexpr double first_row_steps = 8, rows_per_time = 2000;
/// States come evenly and are thinned out later; those of the failure begin denser.
constexpr double first_state_steps = 16, first_failure_steps = 2;
/// States in the ring, four per interval of the even ones.
constexpr std::size_t ring_size = 8;
/// Part of a body's smaller side that a wave may cross between two states of its failure.
constexpr double unseen_way = 0.02;
/// Part of a series' interval by which a state may come too early for it.
constexpr double near_enough = 0.5;
/// Part of a film that shows the failure and half as much time again where the scene does not say: about, see
/// TimeMap.
constexpr double failure_share = 0.6;

/// What a wave takes across the narrowest body's smaller side, by the stable time step or more from one
/// particle to the next (s). 0 in statics.
double crossing_time(const Simulation& simulation) {
    return simulation.narrowest_in_spacings() * simulation.stable_time_step();
}

/// About one state per frame; even, and not few for a short film either.
std::size_t states_for(double frames) {
    return 2 * std::max<std::size_t>(25, static_cast<std::size_t>(frames / 2));
}

/// Is it known beforehand when this will be?
bool is_known(const Moment& moment) { return !moment.event || *moment.event == EventName::start; }

/// When the run ends for certain (s), if it waits for no event.
std::optional<double> known_end(const RunSpec& run) {
    if (run.statics || (run.until && !is_known(*run.until))) return {};
    return run.until ? std::min(run.until->offset, run.max_time) : run.max_time;
}

}  // namespace

std::vector<std::int64_t> EvenStates::keep(double time, std::int64_t step) {
    kept_.push_back(step);
    // In one go, and beyond `time` even where the interval is lost in its digits.
    if (next_ <= time) next_ += interval_ * std::floor((time - next_) / interval_ + 1);
    next_ = std::max(next_, std::nextafter(time, std::numeric_limits<double>::infinity()));
    if (kept_.size() <= most_) return {};
    std::vector<std::int64_t> kept, dropped;
    for (std::size_t k = 0; k < kept_.size(); ++k) (k % 2 == 0 ? kept : dropped).push_back(kept_[k]);
    kept_ = std::move(kept);
    // most is even, so the newest stayed: the next is due twice the old interval after it
    next_ += interval_;
    interval_ *= 2;
    return dropped;
}

Recorder::Recorder(const Scene& scene, const Simulation& simulation, RunMonitor& monitor, RunWriter& writer,
                   StageTimes* profile)
    : simulation_(simulation),
      monitor_(monitor),
      writer_(writer),
      profile_(profile),
      tick_(simulation.physics().statics ? simulation.physics().statics->pause() / first_state_steps
                                         : simulation.time_step()),
      unseen_(unseen_way * crossing_time(simulation)),
      even_most_(states_for(scene.movie.frames())),
      even_(0, first_even_interval(scene), even_most_),
      failure_interval_(std::max(first_failure_steps * tick_, unseen_)),
      failure_most_(states_for(failure_share * scene.movie.frames())) {
    for (const SlowSpec& slow : scene.movie.slow) {
        const double interval = slow.span / static_cast<double>(even_most_);
        if (!is_known(slow.around)) {
            failure_interval_ = std::min(failure_interval_, std::max(first_failure_steps * tick_, interval));
            failure_most_ = even_most_;
            continue;
        }
        const double begin = slow.around.offset - slow.span / 5;
        spans_.push_back({begin, begin + slow.span, EvenStates(begin, interval, even_most_)});
    }
    std::vector<std::string> names;
    for (const Load& load : simulation.physics().loads) names.push_back(load.name);
    writer_.history_header(names, scene.dimension);
    write_row();
    keep(even_);
}

/// So that no state is written that is dropped again, where the end is known.
double Recorder::first_even_interval(const Scene& scene) const {
    const std::optional<double> end = known_end(scene.run);
    return std::max(
        {first_state_steps * tick_, unseen_, end ? *end / static_cast<double>(even_most_ - 1) : 0});
}

void Recorder::look() {
    const double time = simulation_.time();
    const Events& events = monitor_.events();
    if (!monitor_.just_broken().empty()) writer_.breaks(monitor_.just_broken());

    const double interval = std::max(
        {first_row_steps * tick_, unseen_, simulation_.physics().statics ? 0 : time / rows_per_time});
    const bool event = (events.first_break && events.first_break->time == time) ||
                       (events.separation && events.separation->time == time);
    if (event || time - last_row_ >= (monitor_.just_broken().empty() ? 1 : 0.25) * interval) write_row();

    if (even_.due(time)) keep(even_);
    for (Span& span : spans_)
        if (time <= span.end && span.states.due(time)) keep(span.states);

    if (!events.first_break) {
        // As dense as the even states are, four times, or would be if the run ended now.
        const double as_if_ended = time / static_cast<double>(2 * even_most_);
        if (time - last_ring_ < std::max(std::min(even_.interval() / 4, as_if_ended), failure_interval_))
            return;
        last_ring_ = time;
        if (ring_.size() == ring_size) ring_.pop_front();
        const TimedStage timed(profile_, "take states");
        ring_.push_back(copy_motion(simulation_));
        return;
    }
    if (!failure_) {
        write_ring();
        failure_.emplace(time, failure_interval_, failure_most_);
        write_now();
    }
    if (events.separation && !separation_kept_) {
        separation_kept_ = true;
        failure_end_ = time + (time - events.first_break->time) / 2;
        write_now();
    }
    if (time <= failure_end_ && failure_->due(time)) keep(*failure_);
}

void Recorder::finish() {
    if (simulation_.failure() || !std::isfinite(imbalance_)) {
        write_ring();
        return;
    }
    if (simulation_.time() > last_row_) write_row();
    write_now();
}

/// One more reason to keep the state of a step: is it recorded already?
bool Recorder::wanted_already(std::int64_t step) { return ++wanted_[step] > 1; }

void Recorder::write_now() {
    if (wanted_already(simulation_.steps())) return;
    std::optional<TimedStage> taking(std::in_place, profile_, "take states");
    Snapshot state = take_snapshot(simulation_);
    taking.reset();
    last_written_ = state.step;
    write_state(std::move(state));
}

void Recorder::write_ring() {
    std::erase_if(ring_, [&](const Motion& motion) { return wanted_already(motion.step); });
    if (ring_.empty()) return;
    std::optional<TimedStage> taking(std::in_place, profile_, "take states");
    UnbrokenBody body(simulation_);
    for (const Motion& motion : ring_) {
        if (!taking) taking.emplace(profile_, "take states");
        Snapshot state = body.snapshot(motion);
        taking.reset();
        write_state(std::move(state));
    }
    ring_.clear();
}

void Recorder::write_row() {
    const TimedStage timed(profile_, "history");
    const HistoryRow row = monitor_.row();
    imbalance_ = row.imbalance;
    last_row_ = row.time;
    if (std::isfinite(row.imbalance)) writer_.row(row);
}

/// A state that another series has just recorded will do.
void Recorder::keep(EvenStates& series) {
    const double since = static_cast<double>(simulation_.steps() - last_written_) * simulation_.time_step();
    const auto last = wanted_.find(last_written_);
    std::int64_t step = last_written_;
    if (last != wanted_.end() && last->second > 0 && since < near_enough * series.interval()) {
        ++last->second;
    } else {
        write_now();
        step = simulation_.steps();
    }
    for (const std::int64_t old : series.keep(simulation_.time(), step))
        if (--wanted_[old] == 0) writer_.drop_state(old);
}

void Recorder::write_state(Snapshot state) {
    for (const float strain : state.bond_strain)
        largest_strain_ = std::max(largest_strain_, std::abs(static_cast<double>(strain)));
    const TimedStage timed(profile_, "wait for the writer");
    writer_.state(std::move(state));
}

}  // namespace hibi
