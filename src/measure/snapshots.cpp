#include "measure/snapshots.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace hibi {

namespace {

/// Kept finite, and so what is computed of it: a body that is torn beyond all measure exceeds single
/// precision.
float single(double value) {
    constexpr double largest = 1e37;
    return static_cast<float>(std::clamp(value, -largest, largest));
}

/// Rising.
template <int Dim>
std::vector<int> broken_bonds(const State<Dim>& state) {
    const int count = static_cast<int>(state.broken_at.size());
    std::vector<std::vector<int>> of_block(block_count(count));
    parallel_for(count, [&](int begin, int end) {
        for (int b = begin; b < end; ++b)
            if (!state.is_intact(b)) of_block[begin / parallel_block].push_back(b);
    });
    std::vector<int> broken;
    for (const std::vector<int>& some : of_block) broken.insert(broken.end(), some.begin(), some.end());
    return broken;
}

/// `local_states(begin, end)` gives the states of a block of particles.
template <int Dim, class Local>
Snapshot make_snapshot(const Model<Dim>& model, const State<Dim>& state, Local&& local_states) {
    const Particles<Dim>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    const int n = particles.count();
    Snapshot s;
    s.time = state.time;
    s.step = state.step;
    s.displacement.resize(n);
    s.velocity.resize(n);
    s.angle = state.angle;
    s.broken = broken_bonds(state);
    s.damage.assign(n, 0);
    for (const int b : s.broken) {
        s.broken_at.push_back(state.broken_at[b]);
        for (const int i : {bonds.first[b], bonds.second[b]}) ++s.damage[i];
    }
    s.bond_strain.resize(n);
    s.energy.resize(n);
    s.stress.resize(n);
    parallel_for(n, [&](int begin, int end) {
        const std::vector<LocalState<Dim>> locals = local_states(begin, end);
        for (int i = begin; i < end; ++i) {
            s.displacement[i] = to_3d<Dim>(state.displacement[i]);
            s.velocity[i] = to_3d<Dim>(state.velocity[i]);
            if (s.damage[i] > 0) s.damage[i] /= static_cast<float>(bonds.start[i + 1] - bonds.start[i]);
            const LocalState<Dim>& local = locals[i - begin];
            s.bond_strain[i] = single(local.bond_strain);
            s.energy[i] = single(local.energy);
            Mat<3> stress = Mat<3>::Zero();
            stress.template topLeftCorner<Dim, Dim>() = local.stress;
            if (Dim == 2 && model.assumption == Assumption::plane_strain) {
                // no strain across the plane: Hooke's law with that strain zero
                const double nu = model.materials[particles.material[i]].poissons_ratio;
                stress(2, 2) = nu * local.stress.trace();
            }
            s.stress[i] = {single(stress(0, 0)), single(stress(1, 1)), single(stress(2, 2)),
                           single(stress(0, 1)), single(stress(1, 2)), single(stress(0, 2))};
        }
    });
    return s;
}

template <int Dim>
std::vector<double> components(const std::vector<Vec<Dim>>& vectors) {
    const double* const begin = vectors.empty() ? nullptr : vectors.front().data();
    return {begin, begin + Dim * vectors.size()};
}

template <int Dim>
void take_components(const std::vector<double>& from, std::vector<Vec<Dim>>& to) {
    std::copy(from.begin(), from.end(), to.front().data());
}

}  // namespace

Snapshot take_snapshot(const Simulation& simulation) {
    return in_its_dimension(simulation, [](const auto& s) {
        return make_snapshot(s.model(), s.state(), [&](int begin, int end) { return s.local(begin, end); });
    });
}

Motion copy_motion(const Simulation& simulation) {
    return in_its_dimension(simulation, [](const auto& s) {
        return Motion{s.time(), s.steps(), components(s.state().displacement), components(s.state().velocity),
                      s.state().angle};
    });
}

struct UnbrokenBody::Any {
    virtual ~Any() = default;
    virtual Snapshot snapshot(const Motion& motion) = 0;
};

template <int Dim>
struct UnbrokenBody::In final : Any {
    explicit In(const SimulationIn<Dim>& simulation)
        : model(simulation.model()),
          state(initial_state(model)),
          law(make_elastic_law<Dim>(model, simulation.physics().elasticity)) {}

    Snapshot snapshot(const Motion& motion) override {
        state.time = motion.time;
        state.step = motion.step;
        take_components(motion.displacement, state.displacement);
        take_components(motion.velocity, state.velocity);
        state.angle = motion.angle;
        parallel_for(model.particles.count(),
                     [&](int begin, int end) { law->update_displacements(state, begin, end); });
        return make_snapshot(model, state,
                             [&](int begin, int end) { return law->local(state, begin, end); });
    }

    const Model<Dim>& model;
    State<Dim> state;
    std::unique_ptr<ElasticLaw<Dim>> law;
};

UnbrokenBody::UnbrokenBody(const Simulation& simulation)
    : body_(in_its_dimension(simulation, []<int Dim>(const SimulationIn<Dim>& s) -> std::unique_ptr<Any> {
          return std::make_unique<In<Dim>>(s);
      })) {}
UnbrokenBody::~UnbrokenBody() = default;

Snapshot UnbrokenBody::snapshot(const Motion& motion) { return body_->snapshot(motion); }

}  // namespace hibi
