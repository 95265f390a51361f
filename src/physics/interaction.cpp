#include "physics/interaction.hpp"

#include "base/parallel.hpp"
#include "elasticity/frequency.hpp"

namespace hibi {

template <int Dim>
ElasticForces<Dim>::ElasticForces(const Model<Dim>& model, Elasticity elasticity, BreakLimits limits)
    : model_(model),
      elasticity_(elasticity),
      limits_(std::move(limits)),
      law_(make_elastic_law<Dim>(model, elasticity, limits_)) {}

template <int Dim>
StageNames ElasticForces<Dim>::stages() const {
    return {.forces = law_->name()};
}

template <int Dim>
double ElasticForces<Dim>::squared_frequency() {
    const double omega = highest_frequency(model_, *law_);
    return omega * omega;
}

template <int Dim>
void ElasticForces<Dim>::add_energies(const State<Dim>& state, Energies& energies) const {
    energies.elastic += law_->energy(state);
}

template <int Dim>
void ElasticForces<Dim>::rebuild(const State<Dim>& state) {
    law_ = make_elastic_law<Dim>(model_, elasticity_, state, limits_);
    parallel_for(model_.particles.count(),
                 [&](int begin, int end) { law_->update_displacements(state, begin, end); });
}

template <int Dim>
Interactions<Dim>::Interactions(std::unique_ptr<ElasticForces<Dim>> elastic) : elastic_(elastic.get()) {
    add(std::move(elastic));
}

template <int Dim>
void Interactions<Dim>::add_forces(State<Dim>& state, int begin, int end) const {
    for (const auto& interaction : list_) interaction->add_forces(state, begin, end);
}

template <int Dim>
void Interactions<Dim>::sum_forces(State<Dim>& state, const FinishBlock& finish_block) {
    elastic_->suspects = elastic_->law().sum_forces(state, [&](int begin, int end) {
        add_forces(state, begin, end);
        if (finish_block) finish_block(begin, end);
    });
}

template <int Dim>
void Interactions<Dim>::update_and_sum_forces(State<Dim>& state) {
    parallel_for(static_cast<int>(state.displacement.size()),
                 [&](int begin, int end) { elastic_->law().update_displacements(state, begin, end); });
    sum_forces(state);
}

template <int Dim>
void Interactions<Dim>::recompute_forces(State<Dim>& state, const std::vector<int>& blocks) {
    elastic_->law().recompute_forces(state, blocks,
                                     [&](int begin, int end) { add_forces(state, begin, end); });
}

template <int Dim>
Energies Interactions<Dim>::energies(const State<Dim>& state) const {
    Energies energies = state.energies;
    for (const auto& interaction : list_) interaction->add_energies(state, energies);
    return energies;
}

template class ElasticForces<2>;
template class Interactions<2>;

}  // namespace hibi
