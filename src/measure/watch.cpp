#include "measure/watch.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "base/parallel.hpp"

namespace hibi {

Connection::Connection(const std::vector<int>& from, const std::vector<int>& to, const Bonds& bonds)
    : from_(bonds.start.size() - 1, 0), to_(from_) {
    for (const int i : from) from_[i] = 1;
    for (const int i : to) to_[i] = 1;
    existed_ = search(bonds);
}

bool Connection::holds(const Bonds& bonds, std::span<const int> just_broken) {
    if (lost_) return false;
    const bool path_intact =
        std::none_of(just_broken.begin(), just_broken.end(), [&](int b) { return on_path_[b]; });
    if (!path_intact) lost_ = !search(bonds);
    return !lost_;
}

/// Breadth first from all held particles.
bool Connection::search(const Bonds& bonds) {
    const int n = static_cast<int>(from_.size());
    std::vector<int> came_by(n, -2), queue;  // -2: not reached, -1: a start, else the bond
    for (int i = 0; i < n; ++i) {
        if (!from_[i]) continue;
        came_by[i] = -1;
        queue.push_back(i);
    }
    on_path_.assign(bonds.count(), 0);
    for (std::size_t head = 0; head < queue.size(); ++head) {
        int i = queue[head];
        if (to_[i]) {
            for (; came_by[i] >= 0; i = bonds.other(came_by[i], i)) on_path_[came_by[i]] = 1;
            return true;
        }
        for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
            const int b = bonds.bonds_of[k], j = bonds.other(b, i);
            if (!bonds.is_intact(b) || came_by[j] != -2) continue;
            came_by[j] = b;
            queue.push_back(j);
        }
    }
    return false;
}

namespace {

constexpr int settling_steps = 100;

/// Does a chain of intact bonds lead from i to j that is soon found? If not, there may be none.
bool joined_nearby(const Bonds& bonds, int i, int j) {
    constexpr std::size_t most = 500;  // particles; a full search walks them all
    std::vector<int> queue{i};
    std::unordered_set<int> seen{i};
    for (std::size_t head = 0; head < queue.size() && queue.size() < most; ++head) {
        for (int k = bonds.start[queue[head]]; k < bonds.start[queue[head] + 1]; ++k) {
            const int next = bonds.other(bonds.bonds_of[k], queue[head]);
            if (!bonds.is_intact(bonds.bonds_of[k]) || !seen.insert(next).second) continue;
            if (next == j) return true;
            queue.push_back(next);
        }
    }
    return false;
}

int primary_load(const Physics& physics) {
    for (std::size_t l = 0; l < physics.loads.size(); ++l)
        if (physics.loads[l].primary) return static_cast<int>(l);
    return physics.loads.empty() ? -1 : 0;
}

template <int Dim>
Connection held_to_loaded(const Simulation<Dim>& simulation) {
    std::vector<int> held, loaded;
    for (const Hold& hold : simulation.physics().holds)
        held.insert(held.end(), hold.particles.begin(), hold.particles.end());
    if (const int l = primary_load(simulation.physics()); l >= 0)
        loaded = simulation.physics().loads[l].particles;
    const std::unordered_set<int> both(loaded.begin(), loaded.end());
    std::erase_if(held, [&](int i) { return both.count(i) > 0; });
    return {held, loaded, simulation.model().bonds};
}

}  // namespace

template <int Dim>
Watch<Dim>::Watch(const Simulation<Dim>& simulation)
    : simulation_(simulation),
      primary_(primary_load(simulation.physics())),
      connection_(held_to_loaded(simulation)),
      cracks_(simulation.model()) {}

template <int Dim>
void Watch<Dim>::look() {
    const Model<Dim>& model = simulation_.model();
    const LoadReading now = primary_ >= 0 ? simulation_.read(primary_) : LoadReading{};
    events_.end = simulation_.time();

    just_broken_.clear();
    for (std::size_t k = 0; k < simulation_.just_broken().size(); ++k) {
        const int b = simulation_.just_broken()[k], i = model.bonds.first[b], j = model.bonds.second[b];
        const Vec<Dim> middle = (model.particles.position(i) + model.particles.position(j)) / 2;
        just_broken_.push_back(
            {simulation_.time(), b, i, j, to_3d<Dim>(middle), simulation_.breaking_strains()[k]});
    }
    // Most breaks leave both ends joined by a short way round: no new fragment, and no search for one.
    for (const int b : simulation_.just_broken())
        fragments_known_ =
            fragments_known_ && joined_nearby(model.bonds, model.bonds.first[b], model.bonds.second[b]);
    cracks_.grow(model, simulation_.just_broken(), simulation_.time());
    const auto event = [&](int bond) {
        Event e{simulation_.time(), now.load, now.displacement, Vec3::Zero()};
        if (bond >= 0) {
            const std::vector<Vec<Dim>>& X = model.particles.reference_position;
            e.position = to_3d<Dim>((X[model.bonds.first[bond]] + X[model.bonds.second[bond]]) / 2);
        }
        return e;
    };
    if (!just_broken_.empty() && !events_.first_break) {
        const auto most = std::max_element(
            just_broken_.begin(), just_broken_.end(),
            [](const Break& a, const Break& b) { return std::abs(a.strain) < std::abs(b.strain); });
        events_.first_break = event(most->bond);
    }
    const bool together = !connection_.existed() || events_.separation ||
                          connection_.holds(model.bonds, simulation_.just_broken());
    if (!together) events_.separation = event(just_broken_.back().bond);

    if (primary_ < 0) return;
    const bool before_separation = !events_.separation || events_.separation->time == simulation_.time();
    if (before_separation && (!events_.peak_load || now.load > events_.peak_load->load)) {
        events_.peak_load = event(-1);
        peak_confirmed_ = false;
    }
    if (events_.peak_load->load > 0 && now.load <= 0.8 * events_.peak_load->load &&
        (events_.first_break || !simulation_.can_break()))
        peak_confirmed_ = true;
}

template <int Dim>
bool Watch<Dim>::settled() const {
    return simulation_.physics().statics || simulation_.steps() >= settling_steps || events_.first_break;
}

template <int Dim>
const Fragments& Watch<Dim>::fragments() {
    if (!fragments_known_) fragments_ = find_fragments(simulation_.model());
    fragments_known_ = true;
    return fragments_;
}

template <int Dim>
HistoryRow Watch<Dim>::row() {
    const Energies e = simulation_.energies();
    HistoryRow row{.time = simulation_.time(),
                   .kinetic = e.kinetic,
                   .elastic = e.elastic,
                   .contact = e.contact,
                   .damped = e.damped,
                   .released = e.released,
                   .work = e.work,
                   .broken = simulation_.broken(),
                   .momentum = to_3d<Dim>(simulation_.momentum()),
                   .crack = crack(),
                   .fragments = fragments()};
    scale_ = std::max({scale_, std::abs(e.work), e.elastic, e.kinetic});
    row.imbalance = scale_ > 0 ? std::abs(e.sum() - e.work) / scale_ : 0;
    last_ = row.imbalance;
    if (settled()) worst_ = std::max(worst_, row.imbalance);
    if (!events_.first_break) worst_before_break_ = worst_imbalance();
    for (std::size_t l = 0; l < simulation_.physics().loads.size(); ++l) {
        const LoadReading reading = simulation_.read(static_cast<int>(l));
        row.loads.push_back(reading.load);
        row.displacements.push_back(reading.displacement);
    }
    if (primary_ >= 0) {
        row.load = row.loads[primary_];
        row.displacement = row.displacements[primary_];
    }
    return row;
}

template class Watch<2>;

namespace {

/// Kept finite, and so what is computed of it: a body that is torn beyond all measure exceeds single
/// precision.
float single(double value) {
    constexpr double largest = 1e37;
    return static_cast<float>(std::clamp(value, -largest, largest));
}

/// Rising.
std::vector<int> broken_bonds(const Bonds& bonds) {
    std::vector<std::vector<int>> of_block(block_count(bonds.count()));
    parallel_for(bonds.count(), [&](int begin, int end) {
        for (int b = begin; b < end; ++b)
            if (!bonds.is_intact(b)) of_block[begin / parallel_block].push_back(b);
    });
    std::vector<int> broken;
    for (const std::vector<int>& some : of_block) broken.insert(broken.end(), some.begin(), some.end());
    return broken;
}

/// `local_states(begin, end)` gives the states of a block of particles.
template <int Dim, class Local>
Snapshot make_snapshot(const Model<Dim>& model, double time, std::int64_t step, Local&& local_states) {
    const Particles<Dim>& particles = model.particles;
    const Bonds& bonds = model.bonds;
    const int n = particles.count();
    Snapshot s;
    s.time = time;
    s.step = step;
    s.displacement.resize(n);
    s.velocity.resize(n);
    if (model.spin) s.angle = model.spin->angle;
    s.broken = broken_bonds(bonds);
    s.damage.assign(n, 0);
    for (const int b : s.broken) {
        s.broken_at.push_back(bonds.broken_at[b]);
        for (const int i : {bonds.first[b], bonds.second[b]}) ++s.damage[i];
    }
    s.bond_strain.resize(n);
    s.energy.resize(n);
    s.stress.resize(n);
    parallel_for(n, [&](int begin, int end) {
        const std::vector<LocalState<Dim>> locals = local_states(begin, end);
        for (int i = begin; i < end; ++i) {
            s.displacement[i] = to_3d<Dim>(particles.displacement[i]);
            s.velocity[i] = to_3d<Dim>(particles.velocity[i]);
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

}  // namespace

template <int Dim>
Snapshot take_snapshot(const Simulation<Dim>& simulation) {
    return make_snapshot(simulation.model(), simulation.time(), simulation.steps(),
                         [&](int begin, int end) { return simulation.local(begin, end); });
}

template Snapshot take_snapshot<2>(const Simulation<2>&);

template <int Dim>
Motion<Dim> copy_motion(const Simulation<Dim>& simulation) {
    const Model<Dim>& model = simulation.model();
    return {simulation.time(), simulation.steps(), model.particles.displacement, model.particles.velocity,
            model.spin ? model.spin->angle : std::vector<double>()};
}

template Motion<2> copy_motion<2>(const Simulation<2>&);

template <int Dim>
UnbrokenBody<Dim>::UnbrokenBody(const Simulation<Dim>& simulation) : model_(simulation.model()) {
    std::ranges::fill(model_.bonds.broken_at, Bonds::intact);
    law_ = make_elastic_law<Dim>(model_, simulation.physics().elasticity);
}

template <int Dim>
Snapshot UnbrokenBody<Dim>::snapshot(Motion<Dim> motion) {
    model_.particles.displacement = std::move(motion.displacement);
    model_.particles.velocity = std::move(motion.velocity);
    if (model_.spin) model_.spin->angle = std::move(motion.angle);
    parallel_for(model_.particles.count(), [&](int begin, int end) { law_->displaced(model_, begin, end); });
    return make_snapshot(model_, motion.time, motion.step,
                         [&](int begin, int end) { return law_->local(model_, begin, end); });
}

template class UnbrokenBody<2>;

}  // namespace hibi
