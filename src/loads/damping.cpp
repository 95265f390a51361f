#include "loads/damping.hpp"

#include "elasticity/frequency.hpp"
#include "loads/supports.hpp"

namespace hibi {

template <int Dim>
void MassDamping<Dim>::start(State<Dim>& state) {
    const Damping& damping = *physics_.damping;
    state.damping_rate =
        damping.rate ? *damping.rate
                     : 2 * *damping.ratio *
                           first_frequency(model_, held_or_driven(model_.particles.count(), physics_));
}

template class MassDamping<2>;

}  // namespace hibi
