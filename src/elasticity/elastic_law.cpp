#include "elasticity/elastic_law.hpp"

#include "base/parallel.hpp"

namespace hibi {

template <int Dim>
std::vector<int> ElasticLaw<Dim>::forces(State<Dim>& state) {
    parallel_for(static_cast<int>(state.displacement.size()),
                 [&](int begin, int end) { update_displacements(state, begin, end); });
    return sum_forces(state);
}

template std::vector<int> ElasticLaw<2>::forces(State<2>&);
template std::vector<int> ElasticLaw<3>::forces(State<3>&);

}  // namespace hibi
