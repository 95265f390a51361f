#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/units.hpp"
#include "physics/simulation.hpp"

namespace hibi {

namespace {

/// A load step that does not converge is made in parts, down to this one.
constexpr double smallest_part = 1.0 / 64;
/// Times its length to which a bond may be squeezed or stretched: no solid stands more, so the search for
/// such an equilibrium is not worth its time.
constexpr double shortest = 0.1, longest = 4;

}  // namespace

/// Everything that acts at t = 0, weight above all, is raised from nothing.
template <int Dim>
void Simulation<Dim>::start_statics() {
    assert(!model_.spin);
    for (Vec<Dim>& v : model_.particles.velocity) v.setZero();
    for (Driven& d : driven_) model_.particles.displacement[d.particle][d.axis] = d.displacement = 0;
    fragment_.assign(model_.particles.count(), 0);
    equilibrium_.emplace(model_, held_);
    sum_forces();
    const StaticState before = static_state();
    double done = 0, part = 1;
    while (done < 1 && !collapse_) {
        const Settled settled = settle(0, Search::stable_equilibrium, done + part);
        if (settled.found)
            done += part;
        else
            part /= 2;
        if (part < smallest_part)
            collapse_ = collapse_message(
                fmt::format("under {:.3g} % of what acts from the first moment on (gravity, and loads "
                            "without a ramp)",
                            100 * (done + smallest_part)),
                settled, "a smaller load, or less gravity");
        part = std::min(part, 1 - done);
    }
    count_work(before, false);
}

/// Equilibrium at the present load after bonds have broken; or the next load, at which the first bond breaks
/// or the load step ends; then bonds are judged. A bond breaks at the end of a step, as in explicit ones:
/// what is recorded is the state in which it does.
template <int Dim>
void Simulation<Dim>::static_step() {
    if (collapse_) return;
    const std::vector<std::string> names = static_stage_names();
    {
        const TimedStage timed(profile_, names[1].c_str());
        if (!settled_)
            relax();
        else if (highest_utilisation() <= 1)
            raise_loads();
    }
    if (collapse_ || !can_break()) return;
    const TimedStage timed(profile_, names.back().c_str());
    break_overstrained();
}

/// Equilibrium again at the same load, after breaks. Where bonds break one by one and there is none that all
/// bear, the body goes towards it only until the next one breaks: a part that is being torn off would
/// otherwise be drawn out by its last bonds to many times its length.
template <int Dim>
void Simulation<Dim>::relax() {
    const StaticState before = static_state();
    pause();
    Settled settled = settle(load_time_, Search::stable_equilibrium);
    if (can_break() && physics_.statics->sequential && (!settled.found || highest_utilisation() > 1)) {
        if (settled.found) restore(before);
        // The way down the energy is the nearest there is to what the body would do.
        settled = settle(load_time_, Search::next_break);
        if (settled.stopped) go_back_to_next_break();
    }
    settled_ = true;
    if (settled.found || settled.stopped)
        count_work(before, false);
    else
        collapse_ = collapse_message(fmt::format("after the break at t = {}", format_si(load_time_, "s", 4)),
                                     settled, "");
}

/// `way_out`: what to try instead; before the first break only, since later a collapse is an outcome.
template <int Dim>
std::string Simulation<Dim>::collapse_message(const std::string& when, const Settled& settled,
                                              const std::string& way_out) const {
    std::string text = fmt::format("no equilibrium {}", when);
    if (const int i = settled.gave_way; i >= 0)
        text += fmt::format(
            ": body \"{}\" {}, most of all at {}", model_.bodies[model_.particles.body[i]].name,
            settled.senseless ? "is crushed, stretched or flung beyond what a linear law can stand for"
                              : "gives way",
            place_text(i));
    if (broken_ > 0 || way_out.empty()) return text;
    if (settled.senseless)
        return text + fmt::format(
                          "; the loads may be far too large for the material: are their units and "
                          "that of youngs_modulus right? If so, try {}{}",
                          way_out, can_break() ? "" : ", or give the material a break_strain");
    text += fmt::format("; it buckles, or bears no more: try {}; method = \"explicit\" shows the motion",
                        way_out);
    return instability_ ? text + "; " + *instability_ : text;
}

template <int Dim>
std::string Simulation<Dim>::place_text(int particle) const {
    const Vec3 X = place(particle);
    return fmt::format("({:.4g}, {:.4g}) m", X.x(), X.y());
}

/// `share` of the loads; the way led from one time of the loads to another.
template <int Dim>
void Simulation<Dim>::note_instability(const Settled::Unstable& unstable, double from, double to,
                                       double share) {
    const double time = from + unstable.share * (to - from);
    std::string text = fmt::format("equilibrium became unstable at t = {}", format_si(time, "s", 4));
    if (to == 0) text = fmt::format("equilibrium is unstable under {:.3g} % of the first loads", 100 * share);
    for (const Load& load : physics_.loads) {
        if (to == 0 || !load.primary || load.share.empty()) continue;
        Vec3 total = Vec3::Zero();
        for (std::size_t k = 0; k < load.particles.size(); ++k)
            total += to_3d<Dim>(applied_force(load, k, time));
        text += fmt::format(", under a load of {}", format_si(std::abs(total.dot(load.direction)), "N", 4));
    }
    const int i = unstable.particle;
    instability_ = text + fmt::format(": body \"{}\" buckles, most of all at {}",
                                      model_.bodies[model_.particles.body[i]].name, place_text(i));
}

template <int Dim>
void Simulation<Dim>::raise_loads() {
    const double step = physics_.statics->step();
    const double next = (std::floor(time_ / step * (1 + 1e-12) + 1e-12) + 1) * step;
    const double lower = highest_utilisation();
    const StaticState before = static_state();
    smooth_ = true;
    const Settled settled = approach(next);
    if (const double upper = highest_utilisation(); upper > 1)
        find_first_break(before, lower, upper);
    else if (load_time_ < next)
        collapse_ = collapse_message(
            fmt::format("found between the loads at t = {} and {}", format_si(load_time_, "s", 4),
                        format_si(load_time_ + smallest_part * (next - before.load_time), "s", 4)),
            settled, "more load_steps or a smaller load");
    count_work(before, smooth_);
    if (load_time_ > time_)
        time_ = load_time_;
    else
        pause();
}

/// The load stands still, and falls behind the time; the next load step catches up.
template <int Dim>
void Simulation<Dim>::pause() {
    const double left = physics_.statics->duration - time_, pause = physics_.statics->pause();
    time_ += left > 0 ? std::min(pause, left / 4) : pause;
}

/// Raises the loads as far as there is equilibrium, in parts if need be. Returns the last search that failed,
/// if one did.
template <int Dim>
Settled Simulation<Dim>::approach(double to) {
    const double from = load_time_;
    double done = 0, part = 1;
    Settled failed;
    while (done < 1 && part >= smallest_part) {
        const double next = done + part < 1 ? from + (done + part) * (to - from) : to;
        const Settled settled = settle(next, Search::stable_equilibrium);
        if (settled.found) {
            done += part;
            part = std::min(2 * part, 1 - done);
        } else {
            part /= 2;
            failed = settled;
        }
    }
    return failed;
}

/// Equilibrium under a share of the loads of that time. Where there is none, nothing is changed.
template <int Dim>
Settled Simulation<Dim>::settle(double load_time, Search search, double share) {
    const Particles<Dim>& particles = model_.particles;
    const int n = particles.count();
    const std::vector<Vec<Dim>> start = particles.displacement;
    std::vector<LoadState> loads = loads_;
    std::vector<Vec<Dim>> applied(n, Vec<Dim>::Zero()), moved;
    for (std::size_t l = 0; l < loads.size(); ++l) {
        const Load& load = physics_.loads[l];
        for (std::size_t k = 0; k < loads[l].force.size(); ++k) {
            loads[l].force[k] = share * applied_force(load, k, load_time);
            applied[load.particles[k]] += loads[l].force[k];
        }
    }
    if (physics_.gravity)
        for (int i = 0; i < n; ++i)
            applied[i] += share * particles.mass[i] * physics_.gravity->acceleration.template head<Dim>();
    std::vector<Driven> driven = driven_;
    if (!driven.empty()) moved.assign(n, Vec<Dim>::Zero());
    for (Driven& d : driven) {
        const Load& load = physics_.loads[d.load];
        const double to = share * load.ramp(load_time) * load.value[d.axis](place(d.particle), load_time);
        d.moved = moved[d.particle][d.axis] = to - d.displacement;
        d.displacement = to;
    }
    // Bonds that break all together may be torn to any length before they do.
    const bool sensible = broken_ == 0 || physics_.statics->sequential;
    int senseless = -1;
    const auto enough = [&] {
        if (search == Search::next_break) return highest_utilisation() > 1;
        if (sensible) senseless = senseless_bond();
        return senseless >= 0;
    };
    Settled settled = search == Search::stable_equilibrium
                          ? equilibrium_->find_stable(model_, *law_, applied, moved, enough)
                          : equilibrium_->find(model_, *law_, applied, moved, enough);
    if (senseless >= 0) {
        model_.particles.displacement = start;
        settled.stopped = false;
        settled.senseless = true;
        settled.gave_way = model_.bonds.first[senseless];
    }
    if (settled.unstable && broken_ == 0 && !buckled_) {
        note_instability(*settled.unstable, load_time_, load_time, share);
        buckled_ = settled.found;
    }
    if (settled.found) {
        loads_ = std::move(loads);
        driven_ = std::move(driven);
        load_time_ = load_time;
        smooth_ = smooth_ && settled.smooth;
    }
    sum_forces();
    return settled;
}

/// The first bond that is squeezed or stretched beyond sense, or -1.
template <int Dim>
int Simulation<Dim>::senseless_bond() const {
    const Bonds& bonds = model_.bonds;
    const Particles<Dim>& particles = model_.particles;
    for (int b = 0; b < bonds.count(); ++b) {
        const int i = bonds.first[b], j = bonds.second[b];
        if (!bonds.is_intact(b) || fragment_[i]) continue;
        const Vec<Dim> r0 = particles.reference_position[j] - particles.reference_position[i];
        const double times =
            (r0 + particles.displacement[j] - particles.displacement[i]).squaredNorm() / r0.squaredNorm();
        if (!(times >= shortest * shortest && times <= longest * longest)) return b;
    }
    return -1;
}

template <int Dim>
typename Simulation<Dim>::StaticState Simulation<Dim>::static_state() const {
    StaticState state{model_.particles.displacement, loads_, driven_, energies(), load_time_};
    for (Driven& d : state.driven) d.old_force = model_.particles.force[d.particle][d.axis];
    return state;
}

template <int Dim>
void Simulation<Dim>::restore(const StaticState& state) {
    model_.particles.displacement = state.displacement;
    loads_ = state.loads;
    driven_ = state.driven;
    load_time_ = state.load_time;
    sum_forces();
}

/// Work of loads and prescribed motion by the trapezoidal rule. On a smooth path that leaves a balance to be
/// checked; otherwise, after a break or a snap, what the elastic energy lacks was lost on the way. Where it
/// has more than the rule knows of, the work was done late in the step, under more load: beyond a buckling
/// load.
template <int Dim>
void Simulation<Dim>::count_work(const StaticState& before, bool smooth) {
    const Particles<Dim>& particles = model_.particles;
    for (std::size_t l = 0; l < loads_.size(); ++l) {
        for (std::size_t k = 0; k < loads_[l].force.size(); ++k) {
            const int i = physics_.loads[l].particles[k];
            work_ += (before.loads[l].force[k] + loads_[l].force[k])
                         .dot(particles.displacement[i] - before.displacement[i]) /
                     2;
        }
    }
    for (std::size_t k = 0; k < driven_.size(); ++k) {
        const Driven &d = driven_[k], &old = before.driven[k];
        work_ -=
            (old.old_force + particles.force[d.particle][d.axis]) / 2 * (d.displacement - old.displacement);
    }
    if (smooth) return;
    const Energies now = energies(), then = before.energies;
    const double lost = (now.work - then.work) - (now.elastic - then.elastic);
    (lost > 0 ? damped_ : work_) += std::abs(lost);
}

template <int Dim>
std::vector<std::string> Simulation<Dim>::static_stage_names() const {
    std::vector<std::string> names{can_break() ? "raise loads, to the next load step or to the first break"
                                               : "raise loads to the next load step",
                                   "equilibrium (Newton, moment-matched)"};
    if (can_break())
        names.push_back(physics_.statics->sequential ? "break the bond furthest beyond its limit"
                                                     : "break all bonds beyond their limits");
    return names;
}

template class Simulation<2>;

}  // namespace hibi
