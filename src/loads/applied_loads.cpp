#include "loads/applied_loads.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace hibi {

namespace {

/// Of the k-th particle of a load that is no prescribed motion (N).
template <int Dim>
Vec<Dim> applied_force(const Model<Dim>& model, const Load& load, std::size_t k, double time) {
    const Vec3 X = to_3d<Dim>(model.particles.reference_position[load.particles[k]]);
    const double ramp = load.ramp(time);
    if (load.kind == Load::Kind::pressure)
        return -ramp * load.value[0](X, time) * load.share[k].template head<Dim>();
    Vec<Dim> force;
    for (int a = 0; a < Dim; ++a) force[a] = ramp * load.share[k].x() * load.value[a](X, time);
    return force;
}

}  // namespace

template <int Dim>
AppliedLoads<Dim>::AppliedLoads(const Model<Dim>& model, const Physics& physics, State<Dim>& state)
    : model_(model), loads_(physics.loads) {
    for (std::size_t l = 0; l < loads_.size(); ++l) {
        load_start_.push_back(applied_.size());
        if (loads_[l].prescribes_motion()) continue;
        for (std::size_t k = 0; k < loads_[l].particles.size(); ++k)
            applied_.push_back({static_cast<int>(l), loads_[l].particles[k], k});
    }
    load_start_.push_back(applied_.size());
    memory_ = state.remember("applied forces", Dim * applied_.size());
    for (std::size_t k = 0; k < applied_.size(); ++k) by_particle_.push_back(k);
    const auto particle = [&](std::size_t k) { return applied_[k].particle; };
    std::ranges::stable_sort(by_particle_, {}, particle);
    for (int b = 0; b <= block_count(model.particles.count()); ++b)
        block_start_.push_back(
            static_cast<int>(std::ranges::lower_bound(by_particle_, b * parallel_block, {}, particle) -
                             by_particle_.begin()));
}

template <int Dim>
bool AppliedLoads<Dim>::exist(const Physics& physics) {
    return std::ranges::any_of(physics.loads, [](const Load& load) {
        return !load.prescribes_motion() && !load.particles.empty();
    });
}

template <int Dim>
Vec<Dim> AppliedLoads<Dim>::force_at(const Applied& of, double time) const {
    return applied_force(model_, loads_[of.load], of.place, time);
}

template <int Dim>
auto AppliedLoads<Dim>::now(State<Dim>& state, std::size_t k) const {
    return Eigen::Map<Vec<Dim>>(state.memory(memory_).data() + Dim * k);
}
template <int Dim>
auto AppliedLoads<Dim>::now(const State<Dim>& state, std::size_t k) const {
    return Eigen::Map<const Vec<Dim>>(state.memory(memory_).data() + Dim * k);
}

template <int Dim>
void AppliedLoads<Dim>::move(State<Dim>& state, double step) {
    for (std::size_t k = 0; k < applied_.size(); ++k) {
        if (state.released[applied_[k].load]) continue;
        const Vec<Dim> force = force_at(applied_[k], state.time);
        auto now = this->now(state, k);
        state.energies.work += step / 2 * (now + force).dot(state.velocity[applied_[k].particle]);
        now = force;
    }
}

template <int Dim>
void AppliedLoads<Dim>::add_forces(State<Dim>& state, int begin, int) const {
    const int block = begin / parallel_block;
    for (int k = block_start_[block]; k < block_start_[block + 1]; ++k)
        state.force[applied_[by_particle_[k]].particle] += now(state, by_particle_[k]);
}

template <int Dim>
void AppliedLoads<Dim>::add_static_loads(const State<Dim>&, double time, double share,
                                         StaticLoads<Dim>& loads) const {
    for (const Applied& of : applied_) loads.applied[of.particle] += share * force_at(of, time);
}

template <int Dim>
void AppliedLoads<Dim>::take_static_loads(State<Dim>& state, double time, double share) {
    for (std::size_t k = 0; k < applied_.size(); ++k) now(state, k) = share * force_at(applied_[k], time);
}

template <int Dim>
void AppliedLoads<Dim>::add_static_work(const State<Dim>& before, State<Dim>& now) const {
    for (std::size_t k = 0; k < applied_.size(); ++k) {
        const int i = applied_[k].particle;
        now.energies.work += (this->now(before, k) + this->now(now, k))
                                 .dot(now.displacement[i] - before.displacement[i]) /
                             2;
    }
}

template <int Dim>
double AppliedLoads<Dim>::load(const State<Dim>& state, int load) const {
    const Vec<Dim> direction = loads_[load].direction.template head<Dim>();
    double sum = 0;
    for (std::size_t k = load_start_[load]; k < load_start_[load + 1]; ++k)
        sum += now(state, k).dot(direction);
    return sum;
}

template <int Dim>
void AppliedLoads<Dim>::release(State<Dim>& state, int load) {
    for (std::size_t k = load_start_[load]; k < load_start_[load + 1]; ++k) {
        auto now = this->now(state, k);
        state.force[applied_[k].particle] -= now;
        now.setZero();
    }
}

template <int Dim>
double total_applied(const Model<Dim>& model, const Load& load, double time) {
    if (load.prescribes_motion()) return 0;
    Vec3 total = Vec3::Zero();
    for (std::size_t k = 0; k < load.particles.size(); ++k)
        total += to_3d<Dim>(applied_force(model, load, k, time));
    return total.dot(load.direction);
}

template class AppliedLoads<2>;
template class AppliedLoads<3>;
template double total_applied<2>(const Model<2>&, const Load&, double);
template double total_applied<3>(const Model<3>&, const Load&, double);

}  // namespace hibi
