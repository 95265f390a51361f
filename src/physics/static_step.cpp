#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/parallel.hpp"
#include "base/units.hpp"
#include "physics/simulation.hpp"

namespace hibi {

namespace {

/// The load of a break is found to this part of it: in time, or in how far the bond is beyond its limit.
constexpr double break_precision = 1e-6;
constexpr int most_trials = 60;
/// A load step that does not converge is made in parts, down to this one.
constexpr double smallest_part = 1.0 / 64;
/// Bonds as close as this share one limit but for rounding: the first in their order goes.
constexpr double same_utilisation = 1e-8;

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
        const Settled settled = settle(0, done + part);
        if (settled.found)
            done += part;
        else
            part /= 2;
        if (part < smallest_part)
            collapse_ = collapse_message(
                fmt::format("under {:.3g} % of what acts from the first moment on (gravity, and loads "
                            "without a ramp)",
                            100 * (done + smallest_part)),
                settled.gave_way, "a smaller load, or less gravity");
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
    if (!settled_)
        relax();
    else if (highest_utilisation() <= 1)
        raise_loads();
    if (!collapse_ && can_break()) break_overstrained();
}

/// Equilibrium again at the same load, after breaks. Where bonds break one by one and there is none that all
/// bear, the body goes towards it only until the next one breaks: a part that is being torn off would
/// otherwise be drawn out by its last bonds to many times its length.
template <int Dim>
void Simulation<Dim>::relax() {
    const StaticState before = static_state();
    pause();
    Settled settled = settle(load_time_);
    const auto overstrained = [&] { return highest_utilisation() > 1; };
    if (can_break() && physics_.statics->sequential && (!settled.found || overstrained())) {
        if (settled.found) restore(before);
        // The way down the energy is the nearest there is to what the body would do.
        settled = settle(load_time_, 1, overstrained);
        if (settled.stopped) go_back_to_next_break();
    }
    settled_ = true;
    if (settled.found || settled.stopped)
        count_work(before, false);
    else
        collapse_ = collapse_message(fmt::format("after the break at t = {}", format_si(load_time_, "s", 4)),
                                     settled.gave_way, "");
}

/// `way_out`: what to try instead; before the first break only, since later a collapse is an outcome.
template <int Dim>
std::string Simulation<Dim>::collapse_message(const std::string& when, int particle,
                                              const std::string& way_out) const {
    std::string text = fmt::format("no equilibrium {}", when);
    if (particle >= 0) {
        const Vec3 X = place(particle);
        text += fmt::format(": body \"{}\" gives way, most of all at ({:.4g}, {:.4g}) m",
                            model_.bodies[model_.particles.body[particle]].name, X.x(), X.y());
    }
    if (broken_ > 0 || way_out.empty()) return text;
    return text +
           fmt::format("; it buckles, or bears no more: try {}; method = \"explicit\" shows the motion",
                       way_out);
}

/// Within the last step towards equilibrium, to the place where a bond passes its limit.
template <int Dim>
void Simulation<Dim>::go_back_to_next_break() {
    std::vector<Vec<Dim>>& u = model_.particles.displacement;
    const std::vector<Vec<Dim>> start = equilibrium_->before_last_step(), end = u;
    const auto go_to = [&](double share) {
        parallel_for(model_.particles.count(), [&](int first, int last) {
            for (int i = first; i < last; ++i) u[i] = start[i] + share * (end[i] - start[i]);
        });
    };
    double below = 0, beyond = 1;
    while (beyond - below > break_precision) {
        const double middle = (below + beyond) / 2;
        go_to(middle);
        (highest_utilisation() > 1 ? beyond : below) = middle;
    }
    go_to(beyond);
    sum_forces();
}

template <int Dim>
void Simulation<Dim>::raise_loads() {
    const double step = physics_.statics->step();
    const double next = (std::floor(time_ / step * (1 + 1e-12) + 1e-12) + 1) * step;
    const double lower = highest_utilisation();
    const StaticState before = static_state();
    smooth_ = true;
    const int gave_way = approach(next);
    if (const double upper = highest_utilisation(); upper > 1)
        find_first_break(before.load_time, lower, upper);
    else if (load_time_ < next)
        collapse_ = collapse_message(
            fmt::format("found between the loads at t = {} and {}", format_si(load_time_, "s", 4),
                        format_si(load_time_ + smallest_part * (next - before.load_time), "s", 4)),
            gave_way, "more load_steps or a smaller load");
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

/// Raises the loads as far as there is equilibrium, in parts if need be. Returns the particle that gave way
/// when it was last not found, or -1.
template <int Dim>
int Simulation<Dim>::approach(double to) {
    const double from = load_time_;
    double done = 0, part = 1;
    int gave_way = -1;
    while (done < 1 && part >= smallest_part) {
        const Settled settled = settle(done + part < 1 ? from + (done + part) * (to - from) : to);
        if (settled.found) {
            done += part;
            part = std::min(2 * part, 1 - done);
        } else {
            part /= 2;
            gave_way = settled.gave_way;
        }
    }
    return gave_way;
}

/// Between loads that all bonds bear and the present ones, which some do not, finds the first at which a bond
/// is beyond its limit: by the Illinois variant of regula falsi, whose first secant nearly always hits, since
/// strains are almost linear in the load. Breaks nothing.
template <int Dim>
void Simulation<Dim>::find_first_break(double from, double lower, double upper) {
    const double aim = 1 + break_precision / 2;
    StaticState beyond = static_state();
    double to = load_time_, f_from = lower - aim, f_to = upper - aim;
    int side = 0;
    for (int trial = 0; trial < most_trials; ++trial) {
        if (upper <= 1 + break_precision || to - from <= break_precision * to) break;
        const double t = from + (to - from) * std::clamp(f_from / (f_from - f_to), 0.001, 0.999);
        if (!settle(t).found) break;
        const double used = highest_utilisation();
        if (used > 1) {
            beyond = static_state();
            upper = used;
            to = t;
            f_to = used - aim;
            if (side == 1) f_from /= 2;
            side = 1;
        } else {
            from = t;
            f_from = used - aim;
            if (side == -1) f_to /= 2;
            side = -1;
        }
    }
    if (load_time_ != to) restore(beyond);
}

/// Equilibrium under a share of the loads of that time. Where there is none, nothing is changed.
template <int Dim>
Settled Simulation<Dim>::settle(double load_time, double share, const std::function<bool()>& enough) {
    const Particles<Dim>& particles = model_.particles;
    const int n = particles.count();
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
    const Settled settled = equilibrium_->find(model_, *law_, applied, moved, enough);
    if (settled.found) {
        loads_ = std::move(loads);
        driven_ = std::move(driven);
        load_time_ = load_time;
        smooth_ = smooth_ && settled.smooth;
    }
    sum_forces();
    return settled;
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
/// checked; otherwise, after a break or a snap, what the elastic energy lacks was lost on the way.
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
    damped_ += (now.work - then.work) - (now.elastic - then.elastic);
}

/// Growth of L^2 over its limit: above 1 the bond breaks. 0 in fragments, which are frozen with their
/// strains.
template <int Dim>
double Simulation<Dim>::utilisation(int bond) const {
    const Bonds& bonds = model_.bonds;
    const int i = bonds.first[bond], j = bonds.second[bond];
    if (!bonds.is_intact(bond) || fragment_[i]) return 0;
    const Particles<Dim>& particles = model_.particles;
    const Vec<Dim> r0 = particles.reference_position[j] - particles.reference_position[i];
    const Vec<Dim> du = particles.displacement[j] - particles.displacement[i];
    const double growth = (2 * r0.dot(du) + du.squaredNorm()) / r0.squaredNorm();
    return growth / (growth > 0 ? limits_.upper[bond] : limits_.lower[bond]);
}

template <int Dim>
double Simulation<Dim>::highest_utilisation() const {
    double highest = 0;
    if (can_break())
        for (int b = 0; b < model_.bonds.count(); ++b) highest = std::max(highest, utilisation(b));
    return highest;
}

template <int Dim>
void Simulation<Dim>::break_overstrained() {
    const Bonds& bonds = model_.bonds;
    const double highest = highest_utilisation();
    if (highest <= 1) return;
    const bool sequential = physics_.statics->sequential;
    const double enough = sequential ? highest * (1 - same_utilisation) : 1;
    for (int b = 0; b < bonds.count(); ++b) {
        if (!(utilisation(b) > enough)) continue;
        const int i = bonds.first[b], j = bonds.second[b];
        just_broken_.push_back(b);
        breaking_strains_.push_back(
            bond_strain<Dim>(model_.particles.reference_position[j] - model_.particles.reference_position[i],
                             model_.particles.displacement[j] - model_.particles.displacement[i]));
        if (sequential) break;
    }
    break_bonds();
    settled_ = false;
    // What no longer hangs on anything has no equilibrium: it stays where it is.
    const std::vector<char> tied = tied_to_support(bonds, held_);
    for (int i = 0; i < model_.particles.count(); ++i) {
        if (tied[i] || fragment_[i]) continue;
        fragment_[i] = 1;
        equilibrium_->hold(i);
    }
    sum_forces();
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
