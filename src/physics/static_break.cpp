#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "physics/simulation.hpp"

namespace hibi {

namespace {

/// The load of a break is found to this part of it: in time, or in how far the bond is beyond its limit.
constexpr double break_precision = 1e-6;
constexpr int most_trials = 60;
/// Bonds as close as this share one limit but for rounding: the first in their order goes.
constexpr double same_utilisation = 1e-8;

}  // namespace

/// Between loads that all bonds bear and the present ones, which some do not, finds the first at which a bond
/// is beyond its limit: by the Illinois variant of regula falsi, whose first secant nearly always hits, since
/// strains are almost linear in the load. Breaks nothing.
template <int Dim>
void Simulation<Dim>::find_first_break(const StaticState& before, double lower, double upper) {
    const double aim = 1 + break_precision / 2;
    StaticState beyond = static_state(), borne = before;
    double f_from = lower - aim, f_to = upper - aim;
    int side = 0;
    for (int trial = 0; trial < most_trials; ++trial) {
        const double from = borne.load_time, to = beyond.load_time;
        if (upper <= 1 + break_precision || to - from <= break_precision * to) break;
        // What has snapped does not snap back under a smaller load.
        if (!smooth_) restore(borne);
        const double t = from + (to - from) * std::clamp(f_from / (f_from - f_to), 0.001, 0.999);
        if (!settle(t, Search::any_equilibrium).found) break;
        const double used = highest_utilisation();
        if (used > 1) {
            beyond = static_state();
            upper = used;
            f_to = used - aim;
            if (side == 1) f_from /= 2;
            side = 1;
        } else {
            borne = static_state();
            f_from = used - aim;
            if (side == -1) f_to /= 2;
            side = -1;
        }
    }
    if (load_time_ != beyond.load_time) restore(beyond);
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

template class Simulation<2>;

}  // namespace hibi
