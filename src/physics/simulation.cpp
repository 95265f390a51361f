#include "physics/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "base/parallel.hpp"
#include "physics/damage.hpp"
#include "physics/time_step.hpp"

namespace hibi {

namespace {

bool prescribes_motion(const Load& load) {
    return load.kind == Load::Kind::displacement || load.kind == Load::Kind::velocity;
}

}  // namespace

template <int Dim>
Simulation<Dim>::Simulation(Model<Dim> model, Physics physics)
    : model_(std::move(model)), physics_(std::move(physics)) {
    Particles<Dim>& particles = model_.particles;
    const int n = particles.count();
    if (physics_.elasticity == Elasticity::thesis) model_.spin = make_spin(model_);
    const bool can_break = std::any_of(model_.materials.begin(), model_.materials.end(),
                                       [](const Material& m) { return m.can_break(); });
    if (can_break) limits_ = break_limits(model_, break_strains(model_, physics_));
    law_ = make_elastic_law<Dim>(model_, physics_.elasticity, limits_);

    held_ = held_components<Dim>(n, physics_);
    inverse_mass_.resize(n);
    for (int i = 0; i < n; ++i) {
        for (int a = 0; a < Dim; ++a) {
            inverse_mass_[i][a] = held_[i][a] ? 0 : 1 / particles.mass[i];
            if (held_[i][a]) particles.velocity[i][a] = 0;
        }
        if (model_.spin)  // as in the thesis, what is held does not turn
            inverse_inertia_.push_back(inverse_mass_[i].isZero(0) ? 0 : 1 / model_.spin->inertia[i]);
    }

    if (physics_.statics)
        time_step_ = physics_.statics->step();
    else
        choose_time_step(can_break);

    // The state at t = 0: prescribed positions and velocities, then the forces there.
    for (std::size_t l = 0; l < physics_.loads.size(); ++l) {
        const Load& load = physics_.loads[l];
        LoadState& state = loads_.emplace_back();
        if (!prescribes_motion(load)) state.force.assign(load.particles.size(), Vec<Dim>::Zero());
        for (const int i : load.particles) {
            for (int a = 0; a < Dim; ++a) {
                if (!load.driven[a]) continue;
                Driven& d = driven_.emplace_back(Driven{static_cast<int>(l), i, a});
                const double value = load.ramp(0) * load.value[a](place(i), 0);
                (load.kind == Load::Kind::displacement ? d.displacement : d.velocity) = value;
                particles.displacement[i][a] = d.displacement;
                particles.velocity[i][a] = d.velocity;
            }
        }
    }
    list_applied_forces();
    if (physics_.statics) {
        start_statics();
        return;
    }
    list_stages();
    prepare_blocks();
    if (model_.spin) turn_with_neighbours();
    update_loads(0);
    sum_forces();
    kinetic_ = parallel_sum<double>(n, [&](int begin, int end) { return kinetic_energy_of(begin, end); });
    work_ = kinetic_ + law_->energy(model_);  // what is there at the start was put in
}

/// And with it the rate of damping.
template <int Dim>
void Simulation<Dim>::choose_time_step(bool can_break) {
    Particles<Dim>& particles = model_.particles;
    const std::vector<Vec<Dim>> velocity = particles.velocity;  // the estimate leaves the model at rest
    stable_time_step_ = 2 / highest_frequency(model_, *law_);
    particles.velocity = velocity;
    // The energy balance through breaks needs the smaller step.
    time_step_ = physics_.time_step.value_or(physics_.time_step_factor.value_or(can_break ? 0.5 : 0.8) *
                                             stable_time_step_);
    if (!(time_step_ <= stable_time_step_))
        throw std::runtime_error(
            fmt::format("run.time_step: {:.3g} s is above the stable {:.3g} s; leave it out to "
                        "have it chosen",
                        time_step_, stable_time_step_));
    if (physics_.damping)
        damping_rate_ = physics_.damping->rate
                            ? *physics_.damping->rate
                            : 2 * *physics_.damping->ratio * first_frequency(model_, held_);
}

/// Thesis variant: the particles of a body that spins at the start spin with it: each takes the rotation of
/// its neighbourhood, sum r0 x dv / sum |r0|^2.
template <int Dim>
void Simulation<Dim>::turn_with_neighbours() {
    static_assert(Dim == 2, "an angle is plane");
    const Particles<Dim>& particles = model_.particles;
    const Bonds& bonds = model_.bonds;
    for (int i = 0; i < particles.count(); ++i) {
        double turning = 0, square = 0;
        for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
            const int j = bonds.other(bonds.bonds_of[k], i);
            const Vec<Dim> r0 = particles.reference_position[j] - particles.reference_position[i];
            const Vec<Dim> dv = particles.velocity[j] - particles.velocity[i];
            turning += r0.x() * dv.y() - r0.y() * dv.x();
            square += r0.squaredNorm();
        }
        if (square > 0 && inverse_inertia_[i] > 0) model_.spin->velocity[i] = turning / square;
    }
}

template <int Dim>
void Simulation<Dim>::step() {
    just_broken_.clear();
    breaking_strains_.clear();
    ++steps_;
    if (physics_.statics)
        static_step();
    else
        explicit_step();
}

/// What is absent from the physics is no stage.
template <int Dim>
void Simulation<Dim>::list_stages() {
    const auto stage = [&](const char* name, auto&& run) { stages_.push_back({name, run}); };
    stage(damping_rate_ > 0 ? "half kick, damped, and drift" : "half kick and drift",
          [this] { kick_and_drift(); });
    if (!driven_.empty()) stage("prescribed motion", [this] { prescribe_motion(); });
    if (!applied_.empty()) stage("applied loads", [this] { update_loads(time_step_); });
    std::string forces =
        model_.spin ? "bond forces and torques (thesis variant)" : "bond forces (moment-matched)";
    if (can_break()) forces += ", watch limits";
    if (physics_.gravity) forces += ", gravity";
    stage((forces + ", half kick").c_str(), [this] { sum_forces_and_kick(); });
    if (can_break())
        stage("judge and break bonds", [this] {
            if (!suspects_.empty()) judge_and_break();
        });
}

template <int Dim>
void Simulation<Dim>::explicit_step() {
    for (const Stage& stage : stages_) {
        const TimedStage timed(profile_, stage.name.c_str());
        stage.run();
    }
    if (!std::isfinite(kinetic_)) report_failure();
}

/// Half a step of dv/dt = a - c v by the midpoint rule. Returns what damping takes out, which is then m (c dt
/// / 8) |v + v_new|^2 to the last digit.
template <int Dim>
double Simulation<Dim>::kick(int begin, int end) {
    Particles<Dim>& particles = model_.particles;
    const double half = time_step_ / 2, g = damping_rate_ * time_step_ / 4;
    double damped = 0;
    const auto kick_all = [&](auto&& inverse_mass) {
        for (int i = begin; i < end; ++i) {
            Vec<Dim>& v = particles.velocity[i];
            const Vec<Dim> push = half * inverse_mass(i).cwiseProduct(particles.force[i]);
            if (g == 0) {
                v += push;
                continue;
            }
            const Vec<Dim> old = v;
            v = ((1 - g) * v + push) / (1 + g);
            for (int a = 0; a < Dim; ++a)  // driven components are overwritten later, and are not damped
                if (inverse_mass(i)[a] > 0)
                    damped += particles.mass[i] * g / 2 * (old[a] + v[a]) * (old[a] + v[a]);
        }
    };
    // A large body is moved as fast as memory allows: what its particles have in common is not read.
    if (const double same = inverse_mass_of_block_[begin / parallel_block]; same > 0)
        kick_all([all = Vec<Dim>::Constant(same).eval()](int) -> const Vec<Dim>& { return all; });
    else
        kick_all([&](int i) -> const Vec<Dim>& { return inverse_mass_[i]; });
    if (model_.spin) {
        Spin& spin = *model_.spin;
        for (int i = begin; i < end; ++i) {
            double& w = spin.velocity[i];
            const double old = w;
            w = ((1 - g) * w + half * inverse_inertia_[i] * spin.torque[i]) / (1 + g);
            damped += spin.inertia[i] * g / 2 * (old + w) * (old + w);
        }
    }
    return damped;
}

template <int Dim>
double Simulation<Dim>::kinetic_energy_of(int begin, int end) const {
    const Particles<Dim>& particles = model_.particles;
    const bool alike = inverse_mass_of_block_[begin / parallel_block] > 0;
    double sum = 0;
    for (int i = begin; i < end; ++i)
        sum += particles.mass[alike ? begin : i] / 2 * particles.velocity[i].squaredNorm();
    if (model_.spin)
        for (int i = begin; i < end; ++i)
            sum += model_.spin->inertia[i] / 2 * model_.spin->velocity[i] * model_.spin->velocity[i];
    return sum;
}

template <int Dim>
void Simulation<Dim>::kick_and_drift() {
    Particles<Dim>& particles = model_.particles;
    for (Driven& d : driven_) d.old_force = particles.force[d.particle][d.axis];
    time_ = static_cast<double>(steps_) * time_step_;
    parallel_for(particles.count(), [&](int begin, int end) {
        damped_in_block_[begin / parallel_block] = kick(begin, end);
        for (int i = begin; i < end; ++i) particles.displacement[i] += time_step_ * particles.velocity[i];
        if (model_.spin)
            for (int i = begin; i < end; ++i) model_.spin->angle[i] += time_step_ * model_.spin->velocity[i];
        law_->displaced(model_, begin, end);
    });
    for (const double damped : damped_in_block_) damped_ += damped;
}

/// Overwrites what kick and drift did to driven components. Until finish_motion their velocity is the mean
/// over the step, so that velocity * time_step is everybody's movement.
template <int Dim>
void Simulation<Dim>::prescribe_motion() {
    for (Driven& d : driven_) {
        const Load& load = physics_.loads[d.load];
        const double value = load.ramp(time()) * load.value[d.axis](place(d.particle), time());
        const double before = d.displacement, old_velocity = d.velocity;
        if (load.kind == Load::Kind::displacement) {
            d.displacement = value;
            d.moved = value - before;
            d.velocity = d.moved / time_step_;
        } else {
            d.moved = time_step_ * (old_velocity + value) / 2;
            d.displacement = before + d.moved;
            d.velocity = value;
        }
        // The reaction: it opposes all other forces, and speeds the particle up.
        const double m = model_.particles.mass[d.particle];
        work_ += m * (d.velocity * d.velocity - old_velocity * old_velocity) / 2;
        model_.particles.displacement[d.particle][d.axis] = d.displacement;
        model_.particles.velocity[d.particle][d.axis] = d.moved / time_step_;
        law_->displaced(model_, d.particle, d.particle + 1);
    }
}

template <int Dim>
void Simulation<Dim>::finish_motion() {
    Particles<Dim>& particles = model_.particles;
    for (const Driven& d : driven_) {
        work_ -= (d.old_force + particles.force[d.particle][d.axis]) / 2 * d.moved;
        double& v = particles.velocity[d.particle][d.axis];
        kinetic_ += particles.mass[d.particle] / 2 * (d.velocity * d.velocity - v * v);
        v = d.velocity;
    }
}

/// Of the k-th particle of a load that is no prescribed motion (N).
template <int Dim>
Vec<Dim> Simulation<Dim>::applied_force(const Load& load, std::size_t k, double time) const {
    const Vec3 X = place(load.particles[k]);
    const double ramp = load.ramp(time);
    if (load.kind == Load::Kind::pressure)
        return -ramp * load.value[0](X, time) * load.share[k].template head<Dim>();
    Vec<Dim> force;
    for (int a = 0; a < Dim; ++a) force[a] = ramp * load.share[k].x() * load.value[a](X, time);
    return force;
}

/// Applied forces at the current time, and their work over the last `step` seconds by the trapezoidal rule.
template <int Dim>
void Simulation<Dim>::update_loads(double step) {
    for (std::size_t l = 0; l < loads_.size(); ++l) {
        const Load& load = physics_.loads[l];
        if (loads_[l].released) continue;
        for (std::size_t k = 0; k < loads_[l].force.size(); ++k) {
            const int i = load.particles[k];
            const Vec<Dim> force = applied_force(load, k, time());
            Vec<Dim>& now = loads_[l].force[k];
            work_ += step / 2 * (now + force).dot(model_.particles.velocity[i]);
            now = force;
        }
    }
}

template <int Dim>
void Simulation<Dim>::list_applied_forces() {
    const int n = model_.particles.count(), blocks = block_count(n);
    for (int l = 0; l < static_cast<int>(loads_.size()); ++l)
        for (int k = 0; k < static_cast<int>(loads_[l].force.size()); ++k)
            applied_.push_back({physics_.loads[l].particles[k], l, k});
    std::ranges::stable_sort(applied_, {}, &Applied::particle);
    for (int b = 0; b <= blocks; ++b)
        applied_start_.push_back(
            static_cast<int>(std::ranges::lower_bound(applied_, b * parallel_block, {}, &Applied::particle) -
                             applied_.begin()));
}

template <int Dim>
void Simulation<Dim>::prepare_blocks() {
    const int n = model_.particles.count(), blocks = block_count(n);
    damped_in_block_.resize(blocks);
    kinetic_in_block_.resize(blocks);
    for (int b = 0; b < blocks; ++b) {
        const auto first = inverse_mass_.begin() + b * parallel_block;
        const auto last = inverse_mass_.begin() + std::min(n, (b + 1) * parallel_block);
        const Vec<Dim> same = Vec<Dim>::Constant(first->x());
        const bool alike = std::all_of(first, last, [&](const Vec<Dim>& inverse) { return inverse == same; });
        inverse_mass_of_block_.push_back(alike ? same.x() : 0);
    }
}

/// And gravity, to the particles of a block.
template <int Dim>
void Simulation<Dim>::add_applied_forces(int begin, int end) {
    Particles<Dim>& particles = model_.particles;
    const int block = begin / parallel_block;
    for (int k = applied_start_[block]; k < applied_start_[block + 1]; ++k)
        particles.force[applied_[k].particle] += loads_[applied_[k].load].force[applied_[k].place];
    if (!physics_.gravity) return;
    const Vec<Dim> g = physics_.gravity->acceleration.template head<Dim>();
    for (int i = begin; i < end; ++i) particles.force[i] += particles.mass[i] * g;
}

/// All forces of the current displacements.
template <int Dim>
void Simulation<Dim>::sum_forces() {
    parallel_for(model_.particles.count(), [&](int begin, int end) { law_->displaced(model_, begin, end); });
    suspects_ = law_->sum_forces(model_, [&](int begin, int end) { add_applied_forces(begin, end); });
}

template <int Dim>
void Simulation<Dim>::sum_forces_and_kick() {
    suspects_ = law_->sum_forces(model_, [&](int begin, int end) {
        add_applied_forces(begin, end);
        damped_in_block_[begin / parallel_block] = kick(begin, end);
        kinetic_in_block_[begin / parallel_block] = kinetic_energy_of(begin, end);
    });
    kinetic_ = 0;
    for (const double kinetic : kinetic_in_block_) kinetic_ += kinetic;
    for (const double damped : damped_in_block_) damped_ += damped;
    finish_motion();
}

/// All bonds are judged on the same state and then broken, so the result does not depend on their order. What
/// breaks is released at unchanged positions, after the whole step: the energy balance stays an order of
/// magnitude better than with a break between drift and kick.
template <int Dim>
void Simulation<Dim>::judge_and_break() {
    const Particles<Dim>& particles = model_.particles;
    Bonds& bonds = model_.bonds;
    for (const int block : suspects_) {
        const int begin = block * parallel_block, end = std::min(particles.count(), begin + parallel_block);
        // The bonds whose first particle lies in the block follow one another.
        const auto first = std::lower_bound(bonds.first.begin(), bonds.first.end(), begin);
        for (auto b = static_cast<int>(first - bonds.first.begin());
             b < bonds.count() && bonds.first[b] < end; ++b) {
            if (!bonds.is_intact(b)) continue;
            const Vec<Dim>& r0 = model_.bond_vectors[b];
            const Vec<Dim> du =
                particles.displacement[bonds.second[b]] - particles.displacement[bonds.first[b]];
            const double growth = 2 * r0.dot(du) + du.squaredNorm(), square = r0.squaredNorm();
            if (!(growth > limits_.upper[b] * square || growth < limits_.lower[b] * square)) continue;
            just_broken_.push_back(b);
            breaking_strains_.push_back(bond_strain<Dim>(r0, du));
        }
    }
    if (just_broken_.empty()) return;
    break_bonds();
    std::vector<int> blocks;
    for (const int b : just_broken_) {
        for (const int i : {bonds.first[b], bonds.second[b]}) {
            blocks.push_back(i / parallel_block);
            for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k)
                blocks.push_back(bonds.other(bonds.bonds_of[k], i) / parallel_block);
        }
    }
    std::ranges::sort(blocks);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    law_->renew(model_, blocks, [&](int begin, int end) { add_applied_forces(begin, end); });
}

/// Those of just_broken_; the displacements stay.
template <int Dim>
void Simulation<Dim>::break_bonds() {
    Bonds& bonds = model_.bonds;
    // Only the ends of broken bonds change their energy.
    std::vector<int> ends;
    for (const int b : just_broken_) ends.insert(ends.end(), {bonds.first[b], bonds.second[b]});
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    const auto energy = [&] {
        double sum = 0;
        for (const int i : ends) sum += law_->local(model_, i).energy;
        return sum;
    };
    const double before = energy();
    for (const int b : just_broken_) {
        bonds.broken_at[b] = time();
        law_->remove(bonds, b);
    }
    broken_ += static_cast<int>(just_broken_.size());
    released_ += before - energy();
}

template <int Dim>
void Simulation<Dim>::release(int l) {
    if (loads_[l].released) return;
    loads_[l].released = true;
    Particles<Dim>& particles = model_.particles;
    for (std::size_t k = 0; k < loads_[l].force.size(); ++k) {
        particles.force[physics_.loads[l].particles[k]] -= loads_[l].force[k];
        loads_[l].force[k].setZero();
    }
    std::erase_if(driven_, [&](const Driven& d) {
        if (d.load != l) return false;
        held_[d.particle][d.axis] = false;
        inverse_mass_[d.particle][d.axis] = 1 / particles.mass[d.particle];
        if (model_.spin) inverse_inertia_[d.particle] = 1 / model_.spin->inertia[d.particle];
        return true;
    });
}

template <int Dim>
Energies Simulation<Dim>::energies() const {
    Energies e{.kinetic = kinetic_,
               .elastic = law_->energy(model_),
               .damped = damped_,
               .released = released_,
               .work = work_};
    if (physics_.gravity) {
        const Particles<Dim>& particles = model_.particles;
        const Vec<Dim> g = physics_.gravity->acceleration.template head<Dim>();
        e.work += parallel_sum<double>(particles.count(), [&](int begin, int end) {
            double sum = 0;
            for (int i = begin; i < end; ++i) sum += particles.mass[i] * g.dot(particles.displacement[i]);
            return sum;
        });
    }
    return e;
}

template <int Dim>
Vec<Dim> Simulation<Dim>::momentum() const {
    struct Sum {
        Vec<Dim> p = Vec<Dim>::Zero();
        void operator+=(const Sum& other) { p += other.p; }
    };
    return parallel_sum<Sum>(model_.particles.count(),
                             [&](int begin, int end) {
                                 Sum part;
                                 for (int i = begin; i < end; ++i)
                                     part.p += model_.particles.mass[i] * model_.particles.velocity[i];
                                 return part;
                             })
        .p;
}

template <int Dim>
LoadReading Simulation<Dim>::read(int l) const {
    const Load& load = physics_.loads[l];
    const Vec<Dim> direction = load.direction.template head<Dim>();
    // Of a face only the outermost particles count: the layers behind it carry shares of the other sign.
    std::vector<double> share(load.particles.size(), 1);
    for (std::size_t k = 0; k < load.share.size(); ++k)
        share[k] = load.kind == Load::Kind::pressure ? load.share[k].template head<Dim>().dot(direction)
                                                     : load.share[k].x();
    const double total = std::accumulate(share.begin(), share.end(), 0.0);
    double gross = 0;
    for (const double s : share) gross += std::abs(s);
    const bool one_sided = std::abs(total) > 1e-9 * gross;  // the pressure in a ring has no resultant
    LoadReading reading;
    int counted = 0;
    for (std::size_t k = 0; k < load.particles.size(); ++k) {
        if (!loads_[l].force.empty()) reading.load += loads_[l].force[k].dot(direction);
        if (one_sided && share[k] * total <= 0) continue;
        reading.displacement += model_.particles.displacement[load.particles[k]].dot(direction);
        ++counted;
    }
    reading.displacement /= std::max(counted, 1);
    for (const Driven& d : driven_)
        if (d.load == l) reading.load -= model_.particles.force[d.particle][d.axis] * direction[d.axis];
    return reading;
}

template <int Dim>
void Simulation<Dim>::report_failure() {
    const Particles<Dim>& particles = model_.particles;
    for (int i = 0; i < particles.count(); ++i) {
        if (particles.velocity[i].allFinite() && particles.displacement[i].allFinite()) continue;
        failure_ =
            Failure{steps_, time(), i,
                    fmt::format("step {}, t = {:.6g} s: velocity of particle {} (body \"{}\") is no longer "
                                "finite; {}",
                                steps_, time(), i, model_.bodies[particles.body[i]].name, likely_cause())};
        return;
    }
    const auto fastest = std::max_element(particles.velocity.begin(), particles.velocity.end(),
                                          [](const Vec<Dim>& a, const Vec<Dim>& b) {
                                              return a.cwiseAbs().maxCoeff() < b.cwiseAbs().maxCoeff();
                                          });
    const int i = static_cast<int>(fastest - particles.velocity.begin());
    failure_ =
        Failure{steps_, time(), i,
                fmt::format("step {}, t = {:.6g} s: the kinetic energy is no longer finite, fastest is "
                            "particle {} (body \"{}\"); {}",
                            steps_, time(), i, model_.bodies[particles.body[i]].name, likely_cause())};
}

template <int Dim>
double Simulation<Dim>::closest_to_breaking() const {
    const Bonds& bonds = model_.bonds;
    double closest = 0;
    if (!can_break()) return closest;
    for (int b = 0; b < bonds.count(); ++b) {
        if (!bonds.is_intact(b)) continue;
        const int i = bonds.first[b], j = bonds.second[b];
        const double strain = bond_strain<Dim>(
            model_.bond_vectors[b], model_.particles.displacement[j] - model_.particles.displacement[i]);
        const double bound = strain > 0 ? limits_.upper[b] : limits_.lower[b];
        if (std::isfinite(bound)) closest = std::max(closest, strain / (std::sqrt(1 + bound) - 1));
    }
    return closest;
}

template <int Dim>
std::string Simulation<Dim>::likely_cause() const {
    if (!physics_.statics && time_step_ > 0.95 * stable_time_step_)
        return fmt::format("the time step {:.3g} s is too close to the stable {:.3g} s: leave it out",
                           time_step_, stable_time_step_);
    double largest = 0;
    const Bonds& bonds = model_.bonds;
    for (int b = 0; b < bonds.count(); ++b) {
        if (!bonds.is_intact(b)) continue;
        const double length =
            (model_.particles.position(bonds.second[b]) - model_.particles.position(bonds.first[b])).norm();
        largest = std::max(largest, std::abs(length / bonds.rest_length[b] - 1));
    }
    if (!(largest < 0.5))
        return "intact bonds are stretched or squeezed by more than half their length: give the material a "
               "break_strain, lower the load, or raise it more slowly";
    return "the load or the prescribed motion may be far too large for the material: are their units right?";
}

template <int Dim>
std::vector<std::string> Simulation<Dim>::stage_names() const {
    if (physics_.statics) return static_stage_names();
    std::vector<std::string> names;
    for (const Stage& stage : stages_) names.push_back(stage.name);
    return names;
}

template class Simulation<2>;

}  // namespace hibi
