// An interaction that only this test knows is added to a simulation without a change in any source.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/fields.hpp"
#include "physics/interaction.hpp"
#include "simulation/simulation.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

using test::plate;

/// A spring of stiffness k (N/m) from one particle to a fixed point, at which it has no length. Remembers the
/// largest length that it has had at the end of a step.
struct SpringTo {
    int particle = 0;
    double k = 0;
    Vec<2> offset = Vec<2>::Zero();  ///< of the point from where the particle is at rest (m)
    double factor = 0.8;             ///< asked of the time step
};

class Spring final : public Interaction<2> {
 public:
    Spring(const Model<2>& model, State<2>& state, const SpringTo& to)
        : mass_(model.particles.mass[to.particle]), to_(to), longest_(state.remember("longest spring", 1)) {}

    StageNames stages() const override { return {.forces = "spring", .end = "note its length"}; }
    double squared_frequency() override { return to_.k / mass_; }
    double time_step_factor() const override { return to_.factor; }
    void add_forces(State<2>& state, int begin, int end) const override {
        if (to_.particle >= begin && to_.particle < end) state.force[to_.particle] -= to_.k * length(state);
    }
    void end_step(State<2>& state) override {
        double& longest = state.memory(longest_)[0];
        longest = std::max(longest, length(state).norm());
    }
    void add_energies(const State<2>& state, Energies& energies) const override {
        energies.elastic += to_.k / 2 * length(state).squaredNorm();
    }

 private:
    Vec<2> length(const State<2>& state) const { return state.displacement[to_.particle] - to_.offset; }

    double mass_;
    SpringTo to_;
    int longest_;
};

MakeInteraction<2> spring(const SpringTo& to) {
    return [to](const Model<2>& model, const Physics&, State<2>& state) {
        return std::make_unique<Spring>(model, state, to);
    };
}

double longest(const State<2>& state) {
    const auto memory = std::ranges::find(state.memories, "longest spring", &Memory::name);
    return memory == state.memories.end() ? NAN : memory->values.at(0);
}

SimulationIn<2> lone_particle(double speed, const SpringTo& to) {
    Model<2> model = plate(1, 1, 1);
    model.particles.initial_velocity[0] = {speed, 0};
    return {std::move(model), {}, {spring(to)}};
}

/// Steps of velocity Verlet: u_n = v dt sin(n a) / sin(a), sin(a / 2) = w dt / 2 with w = sqrt(k / m).
TEST(Interactions, ALoneParticleSwingsOnItsSpringWithTheRootOfStiffnessOverMass) {
    const double k = 9200, w = 2, v = 3;  // 2300 kg
    SimulationIn<2> simulation = lone_particle(v, {.k = k});
    const double dt = simulation.time_step(), a = 2 * std::asin(w * dt / 2);
    ASSERT_NEAR(a / dt, w, 1e-4 * w);
    double largest = 0;
    for (int step = 1; simulation.time() < 4 * 2 * M_PI / w; ++step) {
        simulation.step();
        const double u = simulation.state().displacement[0].x();
        ASSERT_NEAR(u, v * dt * std::sin(step * a) / std::sin(a), 1e-10) << step;
        largest = std::max(largest, u);
    }
    EXPECT_NEAR(largest, v / w, 1e-3);
}

TEST(Interactions, ItsFrequencyCountsInTheTimeStepAndItsFactorToo) {
    const SimulationIn<2> bare(plate(6, 4, 1), {});
    const double bonds = std::pow(2 / bare.stable_time_step(), 2);
    for (const double k : {1e-3 * bonds * 2300, bonds * 2300, 100 * bonds * 2300}) {
        const SimulationIn<2> with(plate(6, 4, 1), {}, {spring({.particle = 5, .k = k})});
        EXPECT_NEAR(std::pow(2 / with.stable_time_step(), 2), bonds + k / 2300, 1e-9 * (bonds + k / 2300));
        EXPECT_DOUBLE_EQ(with.time_step(), 0.8 * with.stable_time_step());
    }
    const SimulationIn<2> careful(plate(6, 4, 1), {}, {spring({.k = 1, .factor = 0.1})});
    EXPECT_DOUBLE_EQ(careful.time_step(), 0.1 * careful.stable_time_step());
    // The limit is a real one: without it the particle flies off.
    SimulationIn<2> stiff(plate(6, 4, 1), {},
                          {spring({.particle = 5, .k = 1e4 * bonds * 2300, .offset = {1e-6, 0}})});
    for (int step = 0; step < 5000; ++step) stiff.step();
    for (const Vec<2>& u : stiff.state().displacement) EXPECT_LT(u.norm(), 1e-4);
}

TEST(Interactions, EnergyBalancesAndCountsWhatTheSpringHoldsAtTheStart) {
    for (const Vec<2>& offset : {Vec<2>(0, 0), Vec<2>(0.3, 0.1)}) {
        Model<2> model = plate(8, 4, 1);
        for (Vec<2>& v : model.particles.initial_velocity) v = {2, 1};
        SimulationIn<2> simulation(std::move(model), {.time_step_factor = 0.05},
                                   {spring({.particle = 7, .k = 1e6, .offset = offset})});
        const Energies start = simulation.energies();
        EXPECT_NEAR(start.work, 32 * 2300 * 5 / 2.0 + 0.5e6 * offset.squaredNorm(), 1e-6);
        double swung = 0;
        for (int step = 0; step < 4000; ++step) {
            simulation.step();
            const Energies e = simulation.energies();
            ASSERT_NEAR(e.sum() / e.work, 1, 2e-3) << step;
            swung = std::max(swung, 1 - e.kinetic / e.work);
        }
        EXPECT_GT(swung, 0.4);  // much of the motion has gone into spring and bonds
        EXPECT_EQ(simulation.energies().work, start.work);
    }
}

TEST(Interactions, ItsStagesStandAmongTheOthers) {
    const SimulationIn<2> simulation = lone_particle(1, {.k = 1});
    EXPECT_EQ(
        simulation.stage_names(),
        (std::vector<std::string>{"half kick and drift", "bond forces (moment-matched), spring, half kick",
                                  "note its length"}));
}

TEST(Interactions, ItsMemoryIsHandedOver) {
    const SpringTo to{.k = 9200};
    SimulationIn<2> first = lone_particle(3, to);
    double largest = 0;
    while (largest == 0 || first.state().velocity[0].x() > -1) {  // beyond the turning point, on the way back
        first.step();
        largest = std::max(largest, std::abs(first.state().displacement[0].x()));
    }
    EXPECT_EQ(longest(first.state()), largest);
    EXPECT_LT(std::abs(first.state().displacement[0].x()), 0.99 * largest);
    State<2> state;
    from_bytes(to_bytes(first.state()), state);
    SimulationIn<2> second = lone_particle(3, to);
    second.go_on_from(std::move(state));
    for (int step = 0; step < 3; ++step) {
        first.step();
        second.step();
        EXPECT_EQ(longest(second.state()), largest);
        EXPECT_EQ(hash_of(first.state()), hash_of(second.state()));
    }
}

}  // namespace
}  // namespace hibi
