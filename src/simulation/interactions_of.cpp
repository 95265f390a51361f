#include "simulation/interactions_of.hpp"

#include <algorithm>

#include "breaking/breaking.hpp"
#include "breaking/limits.hpp"
#include "loads/applied_loads.hpp"
#include "loads/damping.hpp"
#include "loads/gravity.hpp"
#include "loads/prescribed_motion.hpp"

namespace hibi {

namespace {

template <int Dim>
bool can_break(const Model<Dim>& model) {
    return std::ranges::any_of(model.materials, &Material::can_break);
}

}  // namespace

template <int Dim>
std::unique_ptr<ElasticForces<Dim>> elastic_forces(const Model<Dim>& model, const Physics& physics) {
    BreakLimits limits;
    if (can_break(model)) limits = break_limits(model, break_strains(model, physics));
    return std::make_unique<ElasticForces<Dim>>(model, physics.elasticity, std::move(limits));
}

template <int Dim>
void add_interactions(const Model<Dim>& model, const Physics& physics, State<Dim>& state,
                      Interactions<Dim>& list) {
    if (physics.damping) list.add(std::make_unique<MassDamping<Dim>>(model, physics));
    if (PrescribedMotion<Dim>::exists(physics))
        list.add(std::make_unique<PrescribedMotion<Dim>>(model, physics, state, list.elastic()));
    if (AppliedLoads<Dim>::exist(physics))
        list.add(std::make_unique<AppliedLoads<Dim>>(model, physics, state));
    if (can_break(model)) list.add(std::make_unique<Breaking<Dim>>(model, list));
    if (physics.gravity) list.add(std::make_unique<Weight<Dim>>(model, *physics.gravity));
}

template std::unique_ptr<ElasticForces<2>> elastic_forces<2>(const Model<2>&, const Physics&);
template void add_interactions<2>(const Model<2>&, const Physics&, State<2>&, Interactions<2>&);

}  // namespace hibi
