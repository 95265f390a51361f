#include "simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/parallel.hpp"
#include "dynamics/velocity_verlet.hpp"
#include "simulation/interactions_of.hpp"
#include "statics/load_stepping.hpp"

namespace hibi {

template <int Dim>
SimulationIn<Dim>::SimulationIn(Model<Dim> model, Physics physics,
                                const std::vector<MakeInteraction<Dim>>& more)
    : model_(std::move(model)),
      physics_(std::move(physics)),
      state_(initial_state(model_)),
      interactions_(elastic_forces(model_, physics_)) {
    state_.released.assign(physics_.loads.size(), false);
    add_interactions(model_, physics_, state_, interactions_);
    for (const MakeInteraction<Dim>& make : more) interactions_.add(make(model_, physics_, state_));
    breaking_ = interactions_.template find<Breaking<Dim>>();
    if (physics_.statics)
        mover_ = std::make_unique<LoadStepping<Dim>>(model_, physics_, interactions_, state_);
    else
        mover_ = std::make_unique<VelocityVerlet<Dim>>(model_, physics_, interactions_, state_);
}

template <int Dim>
void SimulationIn<Dim>::go_on_from(State<Dim> state) {
    state_ = std::move(state);
    for (const auto& interaction : interactions_) interaction->rebuild(state_);
    mover_->rebuild(state_);
}

template <int Dim>
std::span<const int> SimulationIn<Dim>::just_broken() const {
    return breaking_ ? breaking_->just_broken() : std::span<const int>();
}

template <int Dim>
std::span<const double> SimulationIn<Dim>::breaking_strains() const {
    return breaking_ ? breaking_->breaking_strains() : std::span<const double>();
}

template <int Dim>
double SimulationIn<Dim>::narrowest_in_spacings() const {
    const Particles<Dim>& particles = model_.particles;
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double narrowest = infinity;
    for (const Body<Dim>& body : model_.bodies) {
        Vec<Dim> low = Vec<Dim>::Constant(infinity), high = -low;
        for (int i = body.begin; i < body.end; ++i) {
            low = low.cwiseMin(particles.reference_position[i]);
            high = high.cwiseMax(particles.reference_position[i]);
        }
        narrowest = std::min(narrowest, (high - low).minCoeff() / body.spacing);
    }
    return narrowest;
}

template <int Dim>
HeldComponents SimulationIn<Dim>::held() const {
    return held_or_driven(particle_count(), physics_, state_.released);
}

template <int Dim>
double SimulationIn<Dim>::closest_to_breaking() const {
    return breaking_ ? breaking_->closest_to_breaking(state_) : 0;
}

template <int Dim>
Vec3 SimulationIn<Dim>::momentum() const {
    struct Sum {
        Vec<Dim> p = Vec<Dim>::Zero();
        void operator+=(const Sum& other) { p += other.p; }
    };
    return to_3d<Dim>(parallel_sum<Sum>(particle_count(), [&](int begin, int end) {
                          Sum part;
                          for (int i = begin; i < end; ++i)
                              part.p += model_.particles.mass[i] * state_.velocity[i];
                          return part;
                      }).p);
}

template <int Dim>
LoadReading SimulationIn<Dim>::read(int l) const {
    const Load& load = physics_.loads[l];
    const Vec<Dim> direction = load.direction.template head<Dim>();
    // Of a face only the outermost particles count: the layers behind it carry shares of the other sign.
    std::vector<double> share(load.particles.size(), 1);
    for (std::size_t k = 0; k < load.share.size(); ++k)
        share[k] = load.kind == Load::Kind::pressure ? load.share[k].template head<Dim>().dot(direction)
                                                     : load.share[k].x();
    const double total = std::accumulate(share.begin(), share.end(), 0.0);
    double gross = 0;
    for (const double s : share) gross += std::abs(s);
    const bool one_sided = std::abs(total) > 1e-9 * gross;  // the pressure in a ring has no resultant
    LoadReading reading;
    int counted = 0;
    for (std::size_t k = 0; k < load.particles.size(); ++k) {
        if (one_sided && share[k] * total <= 0) continue;
        reading.displacement += state_.displacement[load.particles[k]].dot(direction);
        ++counted;
    }
    reading.displacement /= std::max(counted, 1);
    for (const auto& interaction : interactions_) reading.load += interaction->load(state_, l);
    return reading;
}

template <int Dim>
void SimulationIn<Dim>::release(int load) {
    if (state_.released[load]) return;
    for (const auto& interaction : interactions_) interaction->release(state_, load);
    state_.released[load] = true;
    mover_->let_go(state_);
}

template <int Dim>
std::string SimulationIn<Dim>::fastest_particle() const {
    const std::vector<Vec<Dim>>& v = state_.velocity;
    const auto most = std::max_element(v.begin(), v.end(), [](const Vec<Dim>& a, const Vec<Dim>& b) {
        return a.cwiseAbs().maxCoeff() < b.cwiseAbs().maxCoeff();
    });
    const auto i = most - v.begin();
    return fmt::format("particle {} (body \"{}\")", i, model_.bodies[model_.particles.body[i]].name);
}

template class SimulationIn<2>;

}  // namespace hibi
