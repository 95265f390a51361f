#pragma once
#include "physics/interaction.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// The bonds of the model, with their limits where something can break.
template <int Dim>
std::unique_ptr<ElasticForces<Dim>> elastic_forces(const Model<Dim>& model, const Physics& physics);

/// Adds all else that acts on the model. The order is that in which it acts.
template <int Dim>
void add_interactions(const Model<Dim>& model, const Physics& physics, State<Dim>& state,
                      Interactions<Dim>& list);

}  // namespace hibi
