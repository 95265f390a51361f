#include "loads/gravity.hpp"

#include "base/parallel.hpp"

namespace hibi {

template <int Dim>
void Weight<Dim>::add_forces(State<Dim>& state, int begin, int end) const {
    for (int i = begin; i < end; ++i) state.force[i] += model_.particles.mass[i] * g_;
}

template <int Dim>
void Weight<Dim>::add_static_loads(const State<Dim>&, double, double share, StaticLoads<Dim>& loads) const {
    for (int i = 0; i < model_.particles.count(); ++i)
        loads.applied[i] += share * model_.particles.mass[i] * g_;
}

template <int Dim>
void Weight<Dim>::add_energies(const State<Dim>& state, Energies& energies) const {
    energies.work += parallel_sum<double>(model_.particles.count(), [&](int begin, int end) {
        double sum = 0;
        for (int i = begin; i < end; ++i) sum += model_.particles.mass[i] * g_.dot(state.displacement[i]);
        return sum;
    });
}

template class Weight<2>;
template class Weight<3>;

}  // namespace hibi
