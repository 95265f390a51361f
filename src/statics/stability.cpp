#include <algorithm>
#include <cmath>

#include "statics/equilibrium.hpp"

namespace hibi {

namespace {

/// Theta of the softest mode below which an equilibrium is unstable: above, it may be rounding.
constexpr double unstable_theta = -1e-6;
/// How often it is left for another one in one search.
constexpr int most_departures = 4;
/// Lengths tried along the softest mode: this part of the extent, then half of it, and so on.
constexpr double farthest_fall = 0.1;
constexpr int most_shorter_falls = 24;
/// Steps by which a component is driven from one equilibrium to the next; shorter than this part of the
/// extent they are not worth it.
constexpr int most_drives = 30;
constexpr double least_drive = 1e-4;

}  // namespace

/// 1 where free, 0 where held.
template <int Dim>
Eigen::VectorXd Equilibrium<Dim>::free_components() const {
    Eigen::VectorXd free(Dim * model_.particles.count());
    for (int k = 0; k < free.size(); ++k) free[k] = held_[k / Dim][k % Dim] ? 0 : 1;
    return free;
}

template <int Dim>
bool Equilibrium<Dim>::is_unstable() {
    if (!memory_.factorised) return false;  // something is held since: nothing has moved
    if (!memory_.knows_softest) {
        softest_.use(*cholesky_, free_components());
        memory_.knows_softest = true;
    }
    tangent_->shift(0);
    theta_ = softest_.follow([&](const Eigen::VectorXd& x, Eigen::VectorXd& Kx) { multiply_free(x, Kx); });
    return theta_ < unstable_theta;
}

/// How far along the softest mode the potential energy falls (m, in its largest component; negative:
/// backwards, 0 where rounding hides the fall).
template <int Dim>
double Equilibrium<Dim>::fall_along_mode(State<Dim>& state, const std::vector<Vec<Dim>>& applied) {
    std::vector<Vec<Dim>>& u = state.displacement;
    const std::vector<Vec<Dim>> start = u;
    const Eigen::VectorXd shape = softest_.shape() / softest_.shape().maxCoeff();
    const auto energy_at = [&](double length) {
        for (int i = 0; i < model_.particles.count(); ++i)
            u[i] = start[i] + length * shape.segment<Dim>(Dim * i);
        return potential(state, applied);
    };
    largest_potential_ = 0;
    const double before = potential(state, applied);
    double length = farthest_fall * extent_, found = 0;
    for (int k = 0; k < most_shorter_falls && found == 0; ++k, length /= 2) {
        const double there = energy_at(length), back = energy_at(-length);
        const double slack = slack_of_potential();
        if (std::min(there, back) < before - slack) found = there <= back + slack ? length : -length;
    }
    u = start;
    return found;
}

/// From an unstable equilibrium to another one: the component that gives way most is driven, first by
/// `length` (m), until it need not be pulled any more; then let go. Newton's method alone would crawl:
/// sideways a slender body is soft, but only along a curve.
template <int Dim>
Settled Equilibrium<Dim>::follow_mode(State<Dim>& state, const std::vector<Vec<Dim>>& applied,
                                      double length, const std::function<bool()>& enough) {
    Eigen::Index most = 0;
    softest_.shape().maxCoeff(&most);
    const int i = static_cast<int>(most) / Dim, a = static_cast<int>(most) % Dim;
    const auto hold_it = [&](bool hold) {
        held_[i][a] = hold;
        memory_.factorised = false;
    };
    StaticLoads<Dim> driven{applied, std::vector<Vec<Dim>>(applied.size(), Vec<Dim>::Zero())};
    double step = length, push = 0, passed = 0;  // push: of the body, towards where it gives way (N)
    hold_it(true);
    for (int drive = 0; drive < most_drives && std::abs(step) > least_drive * extent_; ++drive) {
        driven.moved[i][a] = step;
        const Settled settled = find(state, driven, enough);
        if (settled.stopped) {
            hold_it(false);
            return settled;
        }
        if (!settled.found) {
            step /= 4;
            continue;
        }
        const double before = push;
        push = std::copysign(1.0, length) * (state.force[i][a] + applied[i][a]);
        if (push <= 0) passed = step;
        if (passed == 0)
            step = std::copysign(std::min(2 * std::abs(step), farthest_fall * extent_), step);
        else if (before != push)
            step *= push / (before - push);  // by the secant
        else
            break;
    }
    hold_it(false);
    return find(state, {applied, {}}, enough);
}

template <int Dim>
Settled Equilibrium<Dim>::find_stable(State<Dim>& state, const StaticLoads<Dim>& loads,
                                      const std::function<bool()>& enough) {
    std::vector<Vec<Dim>>& u = state.displacement;
    std::vector<Vec<Dim>> start = u;
    Settled settled = find(state, loads, enough);
    std::optional<Settled::Unstable> unstable;
    for (int departures = 0; settled.found && is_unstable(); ++departures) {
        const double length = fall_along_mode(state, loads.applied);
        if (length == 0) break;  // neutral
        if (!unstable) {
            const Eigen::VectorXd& shape = softest_.shape();
            Eigen::Index most = 0;
            Eigen::VectorXd pull;
            shape.maxCoeff(&most);
            // As if the stiffness against this mode had fallen evenly from the start on.
            u.swap(start);
            tangent_->update(state);
            u.swap(start);
            const double stiffness = std::max(0.0, multiply_free(shape, pull));
            unstable = {stiffness / (stiffness - theta_), static_cast<int>(most) / Dim};
        }
        const int steps = settled.newton_steps;
        if (departures < most_departures)
            settled = follow_mode(state, loads.applied, length, enough);
        else
            settled.found = false;
        settled.newton_steps += steps;
        settled.smooth = false;
    }
    settled.unstable = unstable;
    if (!settled.found && !settled.stopped && unstable) {
        settled.gave_way = unstable->particle;
        u = start;
        law_.forces(state);
    }
    return settled;
}

template class Equilibrium<2>;

}  // namespace hibi
