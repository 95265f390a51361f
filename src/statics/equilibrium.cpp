#include "statics/equilibrium.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "base/parallel.hpp"
#include "model/intact_bonds.hpp"

namespace hibi {

namespace {

constexpr int most_newton_steps = 40, most_halvings = 12;
/// Iterations beyond which a new factor is cheaper: one costs as much as ten to twenty of them (measured on
/// 2000 to 100 000 particles).
constexpr int most_iterations = 12, most_iterations_when_new = 30;
/// Shifts tried in turn where the tangent is not positive definite.
constexpr double first_shift = 1e-8, last_shift = 10, next_shift = 30;
/// A displacement of this many times the body's extent is a flight, not a way to equilibrium.
constexpr double flight = 10;
/// Of the body's extent: a displacement that is none. Energies of much smaller ones underflow.
constexpr double nothing = 1e-100;

template <int Dim>
double dot(const std::vector<Vec<Dim>>& a, const std::vector<Vec<Dim>>& b) {
    return parallel_sum<double>(static_cast<int>(a.size()), [&](int begin, int end) {
        double sum = 0;
        for (int i = begin; i < end; ++i) sum += a[i].dot(b[i]);
        return sum;
    });
}

}  // namespace

template <int Dim>
Equilibrium<Dim>::Equilibrium(const Model<Dim>& model, ElasticLaw<Dim>& law, const State<Dim>& state,
                              HeldComponents held)
    : model_(model), law_(law), held_(std::move(held)), tangent_(law.tangent(state)) {
    const Particles<Dim>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    const auto refuse = [&](int i) {
        throw std::runtime_error(fmt::format(
            "body \"{}\" can move freely, so it has no equilibrium: hold it with [[fix]], in both "
            "directions and against turning",
            model.bodies[particles.body[i]].name));
    };
    const std::vector<char> tied = tied_to_support(bonds, state, held_);
    for (int i = 0; i < particles.count(); ++i) {
        if (tied[i]) continue;
        each_intact_bond(bonds, state, i, [&](int, int) { refuse(i); });
        hold(i);
    }
    Vec<Dim> low = particles.reference_position.at(0), high = low;
    for (const Vec<Dim>& X : particles.reference_position) {
        low = low.cwiseMin(X);
        high = high.cwiseMax(X);
    }
    extent_ = (high - low).maxCoeff();
    const Eigen::SparseMatrix<double>& K = assemble(state);
    least_force_ = nothing * extent_ * memory_.stiffness.norm();
    cholesky_.emplace(K);
    memory_.factorised = cholesky_->factorise(K);
    if (!memory_.factorised) refuse(0);
    if (const Cholesky::Pivot pivot = cholesky_->weakest(K); pivot.ratio < singular_pivot)
        refuse(pivot.row / Dim);
}

/// The tangent at the state, about which it has been linearised.
template <int Dim>
const Eigen::SparseMatrix<double>& Equilibrium<Dim>::assemble(const State<Dim>& state) {
    const Eigen::SparseMatrix<double>& K = tangent_->assemble(held_);
    ++factorisations_;
    memory_.displacement = state.displacement;
    memory_.intact.resize(state.broken_at.size());
    for (std::size_t b = 0; b < memory_.intact.size(); ++b)
        memory_.intact[b] = state.is_intact(static_cast<int>(b));
    memory_.stiffness = K.diagonal();
    memory_.knows_softest = false;
    return K;
}

template <int Dim>
const typename Equilibrium<Dim>::Memory& Equilibrium<Dim>::memory() {
    memory_.softest = softest_.shape();
    memory_.softest_image = softest_.image();
    return memory_;
}

template <int Dim>
void Equilibrium<Dim>::restore(const State<Dim>& state, Memory memory) {
    softest_.restore(memory.softest, memory.softest_image);
    if (memory.factorised) {
        State<Dim> then = state;
        then.displacement = memory.displacement;
        for (std::size_t b = 0; b < memory.intact.size(); ++b)
            then.broken_at[b] = memory.intact[b] ? Bonds::intact : 0;
        tangent_->update(then);
        tangent_->shift(memory.shift);
        factorise(then);
        if (memory.knows_softest) softest_.go_on_with(*cholesky_, free_components());
    }
    memory_ = std::move(memory);
}

template <int Dim>
void Equilibrium<Dim>::hold(int particle) {
    for (int a = 0; a < Dim; ++a) held_[particle][a] = true;
    memory_.factorised = false;
}

/// Residual, its scale and its floor, from the forces of the law in state.force.
template <int Dim>
void Equilibrium<Dim>::balance(const State<Dim>& state, const std::vector<Vec<Dim>>& applied) {
    const int n = model_.particles.count();
    residual_.resize(Dim * n);
    double squares = 0, rounding = 0;
    for (int i = 0; i < n; ++i) {
        for (int a = 0; a < Dim; ++a) {
            const double total = state.force[i][a] + applied[i][a];
            residual_[Dim * i + a] = held_[i][a] ? 0 : total;
            squares += held_[i][a] ? total * total : applied[i][a] * applied[i][a];
            const double stiff = memory_.stiffness[Dim * i + a] * state.displacement[i][a];
            rounding += stiff * stiff;
        }
    }
    scale_ = std::sqrt(squares);
    floor_ = 2 * std::numeric_limits<double>::epsilon() * std::sqrt(rounding) + least_force_;
}

template <int Dim>
bool Equilibrium<Dim>::factorise(const State<Dim>& state) {
    const Eigen::SparseMatrix<double>& K = assemble(state);
    // A part that can move without resistance, a fragment on a roller say, must not be driven by rounding.
    return cholesky_->factorise(K) && cholesky_->weakest(K).ratio > singular_pivot / 100;
}

/// K x with zeros where held; returns x^T K x.
template <int Dim>
double Equilibrium<Dim>::multiply_free(const Eigen::VectorXd& x, Eigen::VectorXd& Kx) const {
    tangent_->multiply(x, Kx);
    for (int k = 0; k < Kx.size(); ++k)
        if (held_[k / Dim][k % Dim]) Kx[k] = 0;
    return x.dot(Kx);
}

/// step = K^-1 residual to the given accuracy, by what factor there is; false where the factor does not do or
/// K is not positive definite.
template <int Dim>
bool Equilibrium<Dim>::conjugate_gradients(double accuracy, int most) {
    const double goal = accuracy * residual_.norm();
    Eigen::VectorXd r = residual_, z, p, Kp;
    step_.setZero(r.size());
    double rz = 0;
    for (int iteration = 0; iteration < most; ++iteration) {
        cholesky_->solve(r, z);
        ++iterations_;
        const double next = r.dot(z);
        if (iteration == 0)
            p = z;
        else
            p = z + next / rz * p;
        rz = next;
        const double curvature = multiply_free(p, Kp);
        if (!(curvature > 0)) return false;
        step_ += rz / curvature * p;
        r -= rz / curvature * Kp;
        if (r.norm() <= goal) return true;
    }
    return false;
}

template <int Dim>
bool Equilibrium<Dim>::newton_step(const State<Dim>& state, double accuracy, bool& smooth) {
    // A step as long as the body says that something moves almost without resistance.
    const auto is_sane = [&] { return step_.cwiseAbs().maxCoeff() <= extent_; };
    tangent_->shift(0);
    if (memory_.factorised && conjugate_gradients(accuracy, most_iterations) && is_sane()) return true;
    // Where one shift was needed, the next is seldom far from it, and factors are dear.
    const double least = std::max(first_shift, memory_.shift / next_shift);
    for (double shift = 0; shift <= last_shift; shift = std::max(least, next_shift * shift)) {
        tangent_->shift(shift);
        memory_.factorised = factorise(state);
        if (!memory_.factorised) continue;
        memory_.shift = shift;
        if (shift > 0) smooth = false;
        conjugate_gradients(accuracy, most_iterations_when_new);
        if (is_sane() && step_.dot(residual_) > 0) return true;
    }
    return false;
}

template <int Dim>
double Equilibrium<Dim>::potential(const State<Dim>& state, const std::vector<Vec<Dim>>& applied) {
    const double elastic = law_.energy(state), work = dot<Dim>(applied, state.displacement);
    largest_potential_ = std::max({largest_potential_, elastic, std::abs(work)});
    return elastic - work;
}

/// Goes along the Newton step as far as the potential energy falls.
template <int Dim>
bool Equilibrium<Dim>::search_along_step(State<Dim>& state, const std::vector<Vec<Dim>>& applied) {
    std::vector<Vec<Dim>>& u = state.displacement;
    before_step_ = u;
    largest_potential_ = 0;
    const double before = potential(state, applied), slope = residual_.dot(step_);
    double length = 1;
    for (int halving = 0; halving < most_halvings; ++halving, length /= 2) {
        for (int i = 0; i < model_.particles.count(); ++i)
            u[i] = before_step_[i] + length * step_.segment<Dim>(Dim * i);
        // The slack is rounding: near the minimum the energy no longer tells where it lies.
        const double now = potential(state, applied);
        if (now <= before - 1e-4 * length * slope + slack_of_potential()) return true;
    }
    u = before_step_;
    return false;
}

template <int Dim>
Settled Equilibrium<Dim>::find(State<Dim>& state, const StaticLoads<Dim>& loads,
                               const std::function<bool()>& enough) {
    const auto& [applied, moved] = loads;
    std::vector<Vec<Dim>>& u = state.displacement;
    const std::vector<Vec<Dim>> start = u;
    const int n = model_.particles.count();
    Settled settled;
    const auto give_up = [&] {
        double farthest = 0;
        const auto look_for_farthest = [&](const auto& motion_of) {
            for (int i = 0; i < n; ++i) {
                const double motion = motion_of(i);
                if (motion > farthest) farthest = motion, settled.gave_way = i;
            }
        };
        look_for_farthest([&](int i) { return (u[i] - start[i]).norm(); });
        // Stuck at once: where the step that was not taken would have led.
        if (settled.gave_way < 0)
            look_for_farthest([&](int i) { return step_.template segment<Dim>(Dim * i).norm(); });
        u = start;
        law_.forces(state);
        return settled;
    };
    tangent_->update(state);
    law_.forces(state);
    balance(state, applied);
    const double start_floor = floor_;
    if (!moved.empty()) {
        // The free particles follow at once, as they would in a linear body: held ones moved alone would tear
        // at their neighbours.
        Eigen::VectorXd motion(Dim * n), pull;
        for (int i = 0; i < n; ++i) motion.segment<Dim>(Dim * i) = moved[i];
        tangent_->shift(0);
        tangent_->multiply(motion, pull);
        for (int k = 0; k < Dim * n; ++k)
            if (!held_[k / Dim][k % Dim]) residual_[k] -= pull[k];
        if (residual_.norm() <= least_force_)
            step_.setZero(Dim * n);
        else if (!newton_step(state, 1e-6, settled.smooth))
            return give_up();
        for (int i = 0; i < n; ++i) u[i] += moved[i] + step_.segment<Dim>(Dim * i);
        law_.forces(state);
        balance(state, applied);
        tangent_->update(state);
    }
    double least = std::numeric_limits<double>::infinity(), least_share = least;
    int stalled = 0, share_stalled = 0;
    for (;; ++settled.newton_steps) {
        const double norm = residual_.norm();
        settled.residual = scale_ > 0 ? norm / scale_ : 0;
        if (!std::isfinite(norm)) return give_up();
        stalled = norm < 0.5 * least ? 0 : stalled + 1;
        least = std::min(least, norm);
        // Without loads the reactions fall with the residual, from step to step, without end: the search ends
        // where all of them are what rounding leaves of the forces at its start, and keep their ratio.
        if (std::max(norm, scale_) <= start_floor) {
            share_stalled = settled.residual < 0.5 * least_share ? 0 : share_stalled + 1;
            least_share = std::min(least_share, settled.residual);
        }
        const bool at_rest = share_stalled > 2;
        if (at_rest) settled.residual = 0;
        // What no longer shrinks and is small has met rounding in a way that the floor does not foresee.
        if (at_rest || norm <= std::max(tolerance * scale_, floor_) ||
            (stalled > 2 && norm <= 1e3 * tolerance * scale_))
            break;
        if (settled.newton_steps == most_newton_steps) return give_up();
        const double share = std::min(1.0, norm / scale_);
        const double accuracy = std::clamp(share, std::min(0.3 * tolerance / share, 1e-2), 1e-2);
        if (!newton_step(state, accuracy, settled.smooth)) {
            // However stiff the body is made: this load would throw it farther than it is long.
            settled.senseless = step_.cwiseAbs().maxCoeff() > extent_;
            return give_up();
        }
        if (!search_along_step(state, applied)) return give_up();
        for (int i = 0; i < n && !settled.senseless; ++i)
            settled.senseless = !((u[i] - start[i]).cwiseAbs().maxCoeff() <= flight * extent_);
        if (settled.senseless) return give_up();
        law_.forces(state);
        if (enough && enough()) {
            settled.stopped = true;
            return settled;
        }
        balance(state, applied);
        tangent_->update(state);
    }
    settled.found = true;
    return settled;
}

template class Equilibrium<2>;

}  // namespace hibi
