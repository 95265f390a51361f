#include "loads/prescribed_motion.hpp"

#include <algorithm>

namespace hibi {

template <int Dim>
PrescribedMotion<Dim>::PrescribedMotion(const Model<Dim>& model, const Physics& physics, State<Dim>& state,
                                        ElasticForces<Dim>& elastic)
    : model_(model), loads_(physics.loads), elastic_(elastic) {
    for (std::size_t l = 0; l < loads_.size(); ++l)
        for (const int i : loads_[l].particles)
            for (int a = 0; a < Dim; ++a)
                if (loads_[l].driven[a]) driven_.push_back({static_cast<int>(l), i, a});
    displacement_ = state.remember("prescribed displacement", driven_.size());
    velocity_ = state.remember("prescribed velocity", driven_.size());
    moved_.resize(driven_.size());
    force_before_.resize(driven_.size());
}

template <int Dim>
bool PrescribedMotion<Dim>::exists(const Physics& physics) {
    return std::ranges::any_of(physics.loads, [](const Load& load) {
        return !load.particles.empty() && (load.driven[0] || load.driven[1] || load.driven[2]);
    });
}

template <int Dim>
double PrescribedMotion<Dim>::value_at(const Driven& d, double time) const {
    const Load& load = loads_[d.load];
    return load.ramp(time) *
           load.value[d.axis](to_3d<Dim>(model_.particles.reference_position[d.particle]), time);
}

template <int Dim>
void PrescribedMotion<Dim>::start(State<Dim>& state) {
    for (std::size_t k = 0; k < driven_.size(); ++k) {
        const Driven& d = driven_[k];
        double &displacement = state.memory(displacement_)[k], &velocity = state.memory(velocity_)[k];
        (loads_[d.load].kind == Load::Kind::displacement ? displacement : velocity) = value_at(d, 0);
        state.displacement[d.particle][d.axis] = displacement;
        state.velocity[d.particle][d.axis] = velocity;
    }
}

template <int Dim>
void PrescribedMotion<Dim>::begin_step(State<Dim>& state) {
    for (std::size_t k = 0; k < driven_.size(); ++k)
        force_before_[k] = state.force[driven_[k].particle][driven_[k].axis];
}

template <int Dim>
void PrescribedMotion<Dim>::move(State<Dim>& state, double step) {
    for (std::size_t k = 0; k < driven_.size(); ++k) {
        const Driven& d = driven_[k];
        if (state.released[d.load]) continue;
        const double value = value_at(d, state.time);
        double &displacement = state.memory(displacement_)[k], &velocity = state.memory(velocity_)[k];
        const double before = displacement, old_velocity = velocity;
        if (loads_[d.load].kind == Load::Kind::displacement) {
            displacement = value;
            moved_[k] = value - before;
            velocity = moved_[k] / step;
        } else {
            moved_[k] = step * (old_velocity + value) / 2;
            displacement = before + moved_[k];
            velocity = value;
        }
        // The reaction: it opposes all other forces, and speeds the particle up.
        const double m = model_.particles.mass[d.particle];
        state.energies.work += m * (velocity * velocity - old_velocity * old_velocity) / 2;
        state.displacement[d.particle][d.axis] = displacement;
        state.velocity[d.particle][d.axis] = moved_[k] / step;
        elastic_.law().update_displacements(state, d.particle, d.particle + 1);
    }
}

template <int Dim>
void PrescribedMotion<Dim>::finish_motion(State<Dim>& state) {
    for (std::size_t k = 0; k < driven_.size(); ++k) {
        const Driven& d = driven_[k];
        if (state.released[d.load]) continue;
        const double velocity = state.memory(velocity_)[k];
        state.energies.work -= (force_before_[k] + state.force[d.particle][d.axis]) / 2 * moved_[k];
        double& v = state.velocity[d.particle][d.axis];
        state.energies.kinetic += model_.particles.mass[d.particle] / 2 * (velocity * velocity - v * v);
        v = velocity;
    }
}

template <int Dim>
void PrescribedMotion<Dim>::add_static_loads(const State<Dim>& state, double time, double share,
                                             StaticLoads<Dim>& loads) const {
    for (std::size_t k = 0; k < driven_.size(); ++k) {
        const Driven& d = driven_[k];
        loads.moved[d.particle][d.axis] = share * value_at(d, time) - state.memory(displacement_)[k];
    }
}

template <int Dim>
void PrescribedMotion<Dim>::take_static_loads(State<Dim>& state, double time, double share) {
    for (std::size_t k = 0; k < driven_.size(); ++k)
        state.memory(displacement_)[k] = share * value_at(driven_[k], time);
}

template <int Dim>
void PrescribedMotion<Dim>::add_static_work(const State<Dim>& before, State<Dim>& now) const {
    for (std::size_t k = 0; k < driven_.size(); ++k) {
        const Driven& d = driven_[k];
        now.energies.work -= (before.force[d.particle][d.axis] + now.force[d.particle][d.axis]) / 2 *
                             (now.memory(displacement_)[k] - before.memory(displacement_)[k]);
    }
}

template <int Dim>
double PrescribedMotion<Dim>::load(const State<Dim>& state, int load) const {
    double sum = 0;
    if (state.released[load]) return sum;
    for (const Driven& d : driven_)
        if (d.load == load) sum -= state.force[d.particle][d.axis] * loads_[load].direction[d.axis];
    return sum;
}

template class PrescribedMotion<2>;

}  // namespace hibi
