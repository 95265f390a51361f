#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "statics/load_stepping.hpp"

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
void LoadStepping<Dim>::find_first_break(State<Dim>& state, const State<Dim>& before, double lower,
                                         double upper) {
    const double aim = 1 + break_precision / 2;
    State<Dim> beyond = state, borne = before;
    double f_from = lower - aim, f_to = upper - aim;
    int side = 0;
    for (int trial = 0; trial < most_trials; ++trial) {
        const double from = load_time(borne), to = load_time(beyond);
        if (upper <= 1 + break_precision || to - from <= break_precision * to) break;
        // What has snapped does not snap back under a smaller load.
        if (!smooth_) go_back_to(state, borne);
        const double t = from + (to - from) * std::clamp(f_from / (f_from - f_to), 0.001, 0.999);
        if (!settle(state, t, Search::any_equilibrium).found) break;
        const double used = highest_utilisation(state);
        if (used > 1) {
            beyond = state;
            upper = used;
            f_to = used - aim;
            if (side == 1) f_from /= 2;
            side = 1;
        } else {
            borne = state;
            f_from = used - aim;
            if (side == -1) f_to /= 2;
            side = -1;
        }
    }
    if (load_time(state) != load_time(beyond)) go_back_to(state, beyond);
}

/// Within the last step towards equilibrium, to the place where a bond passes its limit.
template <int Dim>
void LoadStepping<Dim>::go_back_to_next_break(State<Dim>& state) {
    std::vector<Vec<Dim>>& u = state.displacement;
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
        (highest_utilisation(state) > 1 ? beyond : below) = middle;
    }
    go_to(beyond);
    interactions_.update_and_sum_forces(state);
}

/// As of Breaking; 0 of broken bonds, and in fragments, which are frozen with their strains.
template <int Dim>
double LoadStepping<Dim>::utilisation(const State<Dim>& state, int bond) const {
    if (!state.is_intact(bond) || is_fragment(state, model_.bonds.first[bond])) return 0;
    return breaking_->utilisation(state, bond);
}

template <int Dim>
double LoadStepping<Dim>::highest_utilisation(const State<Dim>& state) const {
    double highest = 0;
    if (breaking_)
        for (int b = 0; b < model_.bonds.count(); ++b) highest = std::max(highest, utilisation(state, b));
    return highest;
}

template <int Dim>
void LoadStepping<Dim>::break_overstrained(State<Dim>& state) {
    const double highest = highest_utilisation(state);
    if (highest <= 1) return;
    const bool sequential = physics_.statics->sequential;
    const double enough = sequential ? highest * (1 - same_utilisation) : 1;
    std::vector<int> beyond;
    for (int b = 0; b < model_.bonds.count(); ++b) {
        if (!(utilisation(state, b) > enough)) continue;
        beyond.push_back(b);
        if (sequential) break;
    }
    breaking_->break_bonds(state, std::move(beyond));
    settled(state) = false;
    // What no longer hangs on anything has no equilibrium: it stays where it is.
    const std::vector<char> tied = tied_to_support(
        model_.bonds, state, held_or_driven(model_.particles.count(), physics_, state.released));
    for (int i = 0; i < model_.particles.count(); ++i) {
        if (tied[i] || is_fragment(state, i)) continue;
        state.memory(fragment_)[i] = 1;
        equilibrium_->hold(i);
    }
    interactions_.update_and_sum_forces(state);
}

template class LoadStepping<2>;

}  // namespace hibi
