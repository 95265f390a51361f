#pragma once
#include "elasticity/elastic_law.hpp"

namespace hibi {

/// Highest angular frequency of the unloaded model (1/s), to 1e-6, by Lanczos iteration on the very forces
/// that the run will use; nothing is held, which is on the safe side. The stable time step is 2 / omega.
/// Without any bond: that of a wave which crosses a particle in one stable step. The law is of that model and
/// must be told of displacements again.
template <int Dim>
double highest_frequency(const Model<Dim>& model, ElasticLaw<Dim>& law);

/// Angular frequency of the first mode (1/s) with the components of `held` at rest, by inverse iteration on
/// the tangent of the unbroken model at rest. held[i][a] holds component a of particle i. Throws
/// std::runtime_error if the body can move freely: there is no such mode then.
template <int Dim>
double first_frequency(const Model<Dim>& model, const std::vector<std::array<bool, 3>>& held);

/// The limit of the law that `elasticity` names: builds it, and asks highest_frequency. (s)
template <int Dim>
double stable_time_step(const Model<Dim>& model, Elasticity elasticity);

}  // namespace hibi
