#include "model/state.hpp"

namespace hibi {

template <int Dim>
State<Dim> initial_state(const Model<Dim>& model) {
    const std::size_t n = model.particles.reference_position.size();
    State<Dim> state;
    state.displacement.assign(n, Vec<Dim>::Zero());
    state.velocity = model.particles.initial_velocity;
    state.force.assign(n, Vec<Dim>::Zero());
    state.broken_at.assign(model.bonds.first.size(), Bonds::intact);
    return state;
}

template State<2> initial_state(const Model<2>&);
template State<3> initial_state(const Model<3>&);

}  // namespace hibi
