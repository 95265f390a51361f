#include "dynamics/velocity_verlet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/parallel.hpp"

namespace hibi {

template <int Dim>
VelocityVerlet<Dim>::VelocityVerlet(const Model<Dim>& model, const Physics& physics,
                                    Interactions<Dim>& interactions, State<Dim>& state)
    : model_(model), physics_(physics), interactions_(interactions) {
    const int n = model.particles.count();
    const HeldComponents held = held_or_driven(n, physics);
    for (int i = 0; i < n; ++i)
        for (int a = 0; a < Dim; ++a)
            if (held[i][a]) state.velocity[i][a] = 0;
    choose_time_step();
    for (const auto& interaction : interactions_) interaction->start(state);
    interactions_.elastic().law().start(state, held);
    rebuild(state);
    list_stages(state);
    interactions_.update_and_sum_forces(state);
    state.energies.kinetic =
        parallel_sum<double>(n, [&](int begin, int end) { return kinetic_energy_of(state, begin, end); });
    // What is there at the start was put in.
    const Energies there = interactions_.energies(state);
    state.energies.work = there.kinetic + there.elastic + there.contact;
}

template <int Dim>
void VelocityVerlet<Dim>::choose_time_step() {
    double squares = 0, factor = 1;
    for (const auto& interaction : interactions_) {
        squares += interaction->squared_frequency();
        factor = std::min(factor, interaction->time_step_factor());
    }
    stable_time_step_ = 2 / std::sqrt(squares);
    time_step_ =
        physics_.time_step.value_or(physics_.time_step_factor.value_or(factor) * stable_time_step_);
    if (!(time_step_ <= stable_time_step_))
        throw std::runtime_error(
            fmt::format("run.time_step: {:.3g} s is above the stable {:.3g} s; leave it out to "
                        "have it chosen",
                        time_step_, stable_time_step_));
}

template <int Dim>
void VelocityVerlet<Dim>::rebuild(const State<Dim>& state) {
    const int n = model_.particles.count(), blocks = block_count(n);
    const HeldComponents held = held_or_driven(n, physics_, state.released);
    inverse_mass_.resize(n);
    for (int i = 0; i < n; ++i)
        for (int a = 0; a < Dim; ++a) inverse_mass_[i][a] = held[i][a] ? 0 : 1 / model_.particles.mass[i];
    spin_inertia_.clear();
    inverse_spin_inertia_.clear();
    for (int i = 0; state.has_spin() && i < n; ++i) {
        spin_inertia_.push_back(interactions_.elastic().law().spin_inertia(i));
        inverse_spin_inertia_.push_back(all_held<Dim>(held[i]) ? 0 : 1 / spin_inertia_[i]);
    }
    damped_in_block_.resize(blocks);
    kinetic_in_block_.resize(blocks);
    inverse_mass_of_block_.clear();
    for (int b = 0; b < blocks; ++b) {
        const auto first = inverse_mass_.begin() + b * parallel_block;
        const auto last = inverse_mass_.begin() + std::min(n, (b + 1) * parallel_block);
        const Vec<Dim> same = Vec<Dim>::Constant(first->x());
        const bool alike = std::all_of(first, last, [&](const Vec<Dim>& inverse) { return inverse == same; });
        inverse_mass_of_block_.push_back(alike ? same.x() : 0);
    }
}

template <int Dim>
void VelocityVerlet<Dim>::list_stages(const State<Dim>& state) {
    const auto stage = [&](std::string name, auto run) { stages_.push_back({std::move(name), run}); };
    stage(state.damping_rate > 0 ? "half kick, damped, and drift" : "half kick and drift",
          [this](State<Dim>& s) { kick_and_drift(s); });
    std::string forces;
    for (const auto& interaction : interactions_) {
        const StageNames names = interaction->stages();
        if (!names.move.empty())
            stage(names.move, [this, &interaction](State<Dim>& s) { interaction->move(s, time_step_); });
        if (!names.forces.empty()) forces += names.forces + ", ";
    }
    stage(forces + "half kick", [this](State<Dim>& s) { sum_forces_and_kick(s); });
    for (const auto& interaction : interactions_)
        if (const std::string name = interaction->stages().end; !name.empty())
            stage(name, [&interaction](State<Dim>& s) { interaction->end_step(s); });
}

template <int Dim>
std::vector<std::string> VelocityVerlet<Dim>::stage_names() const {
    std::vector<std::string> names;
    for (const Stage& stage : stages_) names.push_back(stage.name);
    return names;
}

template <int Dim>
void VelocityVerlet<Dim>::step(State<Dim>& state) {
    ++state.step;
    for (const Stage& stage : stages_) {
        const TimedStage timed(this->profile_, stage.name.c_str());
        stage.run(state);
    }
    if (!std::isfinite(state.energies.kinetic)) report_failure(state);
}

/// Half a step of dv/dt = a - c v by the midpoint rule. Returns what damping takes out, which is then m (c dt
/// / 8) |v + v_new|^2 to the last digit.
template <int Dim>
double VelocityVerlet<Dim>::kick(State<Dim>& state, int begin, int end) const {
    const double half = time_step_ / 2, g = state.damping_rate * time_step_ / 4;
    double damped = 0;
    const auto kick_all = [&](auto&& inverse_mass) {
        for (int i = begin; i < end; ++i) {
            Vec<Dim>& v = state.velocity[i];
            const Vec<Dim> push = half * inverse_mass(i).cwiseProduct(state.force[i]);
            if (g == 0) {
                v += push;
                continue;
            }
            const Vec<Dim> old = v;
            v = ((1 - g) * v + push) / (1 + g);
            for (int a = 0; a < Dim; ++a)  // driven components are overwritten later, and are not damped
                if (inverse_mass(i)[a] > 0)
                    damped += model_.particles.mass[i] * g / 2 * (old[a] + v[a]) * (old[a] + v[a]);
        }
    };
    // A large body is moved as fast as memory allows: what its particles have in common is not read.
    if (const double same = inverse_mass_of_block_[begin / parallel_block]; same > 0)
        kick_all([all = Vec<Dim>::Constant(same).eval()](int) -> const Vec<Dim>& { return all; });
    else
        kick_all([&](int i) -> const Vec<Dim>& { return inverse_mass_[i]; });
    if (state.has_spin()) {
        for (int i = begin; i < end; ++i) {
            double& w = state.angular_velocity[i];
            const double old = w;
            w = ((1 - g) * w + half * inverse_spin_inertia_[i] * state.torque[i]) / (1 + g);
            damped += spin_inertia_[i] * g / 2 * (old + w) * (old + w);
        }
    }
    return damped;
}

template <int Dim>
double VelocityVerlet<Dim>::kinetic_energy_of(const State<Dim>& state, int begin, int end) const {
    const std::vector<double>& mass = model_.particles.mass;
    const bool alike = inverse_mass_of_block_[begin / parallel_block] > 0;
    double sum = 0;
    for (int i = begin; i < end; ++i) sum += mass[alike ? begin : i] / 2 * state.velocity[i].squaredNorm();
    if (state.has_spin())
        for (int i = begin; i < end; ++i)
            sum += spin_inertia_[i] / 2 * state.angular_velocity[i] * state.angular_velocity[i];
    return sum;
}

template <int Dim>
void VelocityVerlet<Dim>::kick_and_drift(State<Dim>& state) {
    for (const auto& interaction : interactions_) interaction->begin_step(state);
    state.time = static_cast<double>(state.step) * time_step_;
    parallel_for(model_.particles.count(), [&](int begin, int end) {
        damped_in_block_[begin / parallel_block] = kick(state, begin, end);
        for (int i = begin; i < end; ++i) state.displacement[i] += time_step_ * state.velocity[i];
        if (state.has_spin())
            for (int i = begin; i < end; ++i) state.angle[i] += time_step_ * state.angular_velocity[i];
        interactions_.elastic().law().update_displacements(state, begin, end);
    });
    for (const double damped : damped_in_block_) state.energies.damped += damped;
}

template <int Dim>
void VelocityVerlet<Dim>::sum_forces_and_kick(State<Dim>& state) {
    interactions_.sum_forces(state, [&](int begin, int end) {
        damped_in_block_[begin / parallel_block] = kick(state, begin, end);
        kinetic_in_block_[begin / parallel_block] = kinetic_energy_of(state, begin, end);
    });
    state.energies.kinetic = 0;
    for (const double kinetic : kinetic_in_block_) state.energies.kinetic += kinetic;
    for (const double damped : damped_in_block_) state.energies.damped += damped;
    for (const auto& interaction : interactions_) interaction->finish_motion(state);
}

template <int Dim>
void VelocityVerlet<Dim>::report_failure(State<Dim>& state) const {
    const int n = model_.particles.count();
    int culprit = -1;
    std::string what = "velocity of particle {} (body \"{}\") is no longer finite";
    for (int i = 0; i < n && culprit < 0; ++i)
        if (!state.velocity[i].allFinite() || !state.displacement[i].allFinite()) culprit = i;
    if (culprit < 0) {
        what = "the kinetic energy is no longer finite, fastest is particle {} (body \"{}\")";
        const auto fastest = std::max_element(state.velocity.begin(), state.velocity.end(),
                                              [](const Vec<Dim>& a, const Vec<Dim>& b) {
                                                  return a.cwiseAbs().maxCoeff() < b.cwiseAbs().maxCoeff();
                                              });
        culprit = static_cast<int>(fastest - state.velocity.begin());
    }
    state.failure = fmt::format(
        "step {}, t = {:.6g} s: {}; {}", state.step, state.time,
        fmt::format(fmt::runtime(what), culprit, model_.bodies[model_.particles.body[culprit]].name),
        likely_cause(model_, state, *this));
}

template class VelocityVerlet<2>;

}  // namespace hibi
