#include "measure/run_monitor.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "base/fields.hpp"
#include "measure/cracks.hpp"
#include "measure/load_path.hpp"

namespace hibi {

namespace {

constexpr int settling_steps = 100;

/// Does a chain of intact bonds lead from i to j that is soon found? If not, there may be none.
template <int Dim>
bool joined_nearby(const Bonds& bonds, const State<Dim>& state, int i, int j) {
    constexpr std::size_t most = 500;  // particles; a full search walks them all
    std::vector<int> queue{i};
    std::unordered_set<int> seen{i};
    bool joined = false;
    for (std::size_t head = 0; head < queue.size() && queue.size() < most && !joined; ++head)
        each_intact_bond(bonds, state, queue[head], [&](int next, int) {
            joined = joined || next == j;
            if (seen.insert(next).second) queue.push_back(next);
        });
    return joined;
}

int primary_load(const Physics& physics) {
    for (std::size_t l = 0; l < physics.loads.size(); ++l)
        if (physics.loads[l].primary) return static_cast<int>(l);
    return physics.loads.empty() ? -1 : 0;
}

template <int Dim>
LoadPath<Dim> held_to_loaded(const SimulationIn<Dim>& simulation) {
    std::vector<int> held, loaded;
    for (const Hold& hold : simulation.physics().holds)
        held.insert(held.end(), hold.particles.begin(), hold.particles.end());
    if (const int l = primary_load(simulation.physics()); l >= 0)
        loaded = simulation.physics().loads[l].particles;
    const std::unordered_set<int> both(loaded.begin(), loaded.end());
    std::erase_if(held, [&](int i) { return both.count(i) > 0; });
    return {held, loaded, simulation.model().bonds, simulation.state()};
}

template <int Dim>
class RunMonitorIn final : public RunMonitor {
 public:
    explicit RunMonitorIn(const SimulationIn<Dim>& simulation)
        : simulation_(simulation), load_path_(held_to_loaded(simulation)), cracks_(simulation.model()) {
        primary_ = primary_load(simulation.physics());
    }

    void look() override;
    bool settled() const override {
        return simulation_.physics().statics || simulation_.steps() >= settling_steps || events_.first_break;
    }
    bool can_separate() const override { return load_path_.existed(); }
    HistoryRow row() override;
    CrackReading crack() const override { return cracks_.read(simulation_.time()); }
    double top_crack_speed() const override { return cracks_.top_speed(); }
    const Fragments& fragments() override;

    std::string state() const override { return to_bytes(*this); }
    void go_on_from(const std::string& state) override {
        from_bytes(state, *this);
        if (load_path_.existed()) load_path_.restore(simulation_.state());
    }
    template <class Self, class Visit>
    static void each_field(Self& self, Visit&& visit) {
        visit("events", self.events_);
        visit("cracks", self.cracks_);
        visit("fragments", self.fragments_);
        visit("fragments_known", self.fragments_known_);
        visit("peak_confirmed", self.peak_confirmed_);
        visit("scale", self.scale_);
        visit("worst", self.worst_);
        visit("worst_before_break", self.worst_before_break_);
        visit("last", self.last_);
    }

 private:
    Event event(const LoadReading& now, int bond) const;

    const SimulationIn<Dim>& simulation_;
    LoadPath<Dim> load_path_;
    Cracks<Dim> cracks_;
    Fragments fragments_;
    bool fragments_known_ = false;  ///< as the bonds are now
};

/// What is true now; of a bond or, where there is none, -1.
template <int Dim>
Event RunMonitorIn<Dim>::event(const LoadReading& now, int bond) const {
    Event e{simulation_.time(), now.load, now.displacement, Vec3::Zero()};
    const Model<Dim>& model = simulation_.model();
    const std::vector<Vec<Dim>>& X = model.particles.reference_position;
    if (bond >= 0) e.position = to_3d<Dim>((X[model.bonds.first[bond]] + X[model.bonds.second[bond]]) / 2);
    return e;
}

template <int Dim>
void RunMonitorIn<Dim>::look() {
    const Bonds& bonds = simulation_.model().bonds;
    const State<Dim>& state = simulation_.state();
    const LoadReading now = primary_ >= 0 ? simulation_.read(primary_) : LoadReading{};
    events_.end = simulation_.time();

    just_broken_.clear();
    for (std::size_t k = 0; k < simulation_.just_broken().size(); ++k) {
        const int b = simulation_.just_broken()[k], i = bonds.first[b], j = bonds.second[b];
        const Vec<Dim> middle =
            (position(simulation_.model(), state, i) + position(simulation_.model(), state, j)) / 2;
        just_broken_.push_back(
            {simulation_.time(), b, i, j, to_3d<Dim>(middle), simulation_.breaking_strains()[k]});
    }
    // Most breaks leave both ends joined by a short way round: no new fragment, and no search for one.
    for (const int b : simulation_.just_broken())
        fragments_known_ = fragments_known_ && joined_nearby(bonds, state, bonds.first[b], bonds.second[b]);
    cracks_.grow(simulation_.model(), simulation_.just_broken(), simulation_.time());
    if (!just_broken_.empty() && !events_.first_break) {
        const auto most = std::max_element(
            just_broken_.begin(), just_broken_.end(),
            [](const Break& a, const Break& b) { return std::abs(a.strain) < std::abs(b.strain); });
        events_.first_break = event(now, most->bond);
    }
    const bool together = !load_path_.existed() || events_.separation ||
                          load_path_.holds(state, simulation_.just_broken());
    if (!together) events_.separation = event(now, just_broken_.back().bond);

    if (primary_ < 0) return;
    const bool before_separation = !events_.separation || events_.separation->time == simulation_.time();
    if (before_separation && (!events_.peak_load || now.load > events_.peak_load->load)) {
        events_.peak_load = event(now, -1);
        peak_confirmed_ = false;
    }
    if (events_.peak_load->load > 0 && now.load <= 0.8 * events_.peak_load->load &&
        (events_.first_break || !simulation_.can_break()))
        peak_confirmed_ = true;
}

template <int Dim>
const Fragments& RunMonitorIn<Dim>::fragments() {
    if (!fragments_known_) fragments_ = find_fragments(simulation_.model(), simulation_.state());
    fragments_known_ = true;
    return fragments_;
}

template <int Dim>
HistoryRow RunMonitorIn<Dim>::row() {
    const Energies e = simulation_.energies();
    HistoryRow row{.time = simulation_.time(),
                   .kinetic = e.kinetic,
                   .elastic = e.elastic,
                   .contact = e.contact,
                   .damped = e.damped,
                   .released = e.released,
                   .work = e.work,
                   .broken = simulation_.broken(),
                   .momentum = simulation_.momentum(),
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

}  // namespace

std::unique_ptr<RunMonitor> make_run_monitor(const Simulation& simulation) {
    return in_its_dimension(simulation,
                            []<int Dim>(const SimulationIn<Dim>& s) -> std::unique_ptr<RunMonitor> {
                                return std::make_unique<RunMonitorIn<Dim>>(s);
                            });
}

}  // namespace hibi
