// A second simulation, given the State of the first in mid-run, goes on with the same bits.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "base/fields.hpp"
#include "base/parallel.hpp"
#include "measure/run_monitor.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

using test::plate;
using test::where;

Material brittle(double strain, double weibull_shape = 0) {
    Material m = test::concrete();
    m.break_strain = strain;
    if (weibull_shape > 0) m.weibull = Weibull{.shape = weibull_shape, .seed = 3};
    return m;
}

std::vector<int> between(const Model<2>& model, double from, double to) {
    return where(model, [&](const Vec<2>& X) { return X.x() > from && X.x() < to; });
}

Hold clamp(const Model<2>& model, double to = 1) {
    return {"clamp", between(model, -1, to), {true, true, false}};
}

Load driven(std::vector<int> particles, Load::Kind kind, std::array<bool, 3> axes, const Vec<2>& value,
            double ramp) {
    Load load;
    load.name = "grip";
    load.kind = kind;
    load.particles = std::move(particles);
    load.driven = axes;
    load.value = {Field(value.x()), Field(value.y()), Field(0)};
    load.ramp = {ramp};
    return load;
}

// Explicit runs are of more than two blocks of particles: two threads have work.
constexpr int columns = 72, rows = 36;

SimulationIn<2> pulled(Elasticity elasticity, double weibull_shape) {
    Model<2> model = plate(columns, rows, 1, brittle(4e-4, weibull_shape));
    Physics physics;
    physics.elasticity = elasticity;
    physics.holds = {clamp(model)};
    physics.loads = {test::pull(model, between(model, columns - 1, columns), {4e6, -2e6}, 0.05),
                     test::pull(model, between(model, 30, 31), {0, -4e6}, 0)};
    physics.loads[1].value[1] =
        Field([](const Vec3&, double t) { return -4e6 * std::sin(40 * t); }, false, true, "");
    physics.damping = Damping{.rate = 3};
    return {std::move(model), physics};
}

SimulationIn<2> loads_damping_and_scattered_breaks() { return pulled(Elasticity::moment_matched, 5); }
SimulationIn<2> thesis_variant() { return pulled(Elasticity::thesis, 0); }

SimulationIn<2> motion_and_gravity() {
    Model<2> model = plate(columns, rows, 1, brittle(2e-3));
    for (Vec<2>& v : model.particles.initial_velocity) v = {0.1, 0};
    Physics physics;
    physics.gravity = Gravity{{0, -9.81, 0}};
    physics.holds = {clamp(model)};
    physics.loads = {
        driven(between(model, columns - 1, columns), Load::Kind::velocity, {true, false, false}, {3, 0},
               0.03),
        driven(between(model, 40, 41), Load::Kind::displacement, {false, true, false}, {0, -0.1}, 0.2)};
    return {std::move(model), physics};
}

SimulationIn<2> statics(bool sequential) {
    Model<2> model = plate(20, 10, 1, brittle(0.05));
    Physics physics;
    physics.gravity = Gravity{{0, -1, 0}};
    physics.holds = {clamp(model)};
    physics.loads = {test::pull(model, between(model, 19, 20), {0, -2e7}, 1)};
    physics.statics = Statics{.duration = 1, .load_steps = 10, .sequential = sequential};
    return {std::move(model), physics};
}
SimulationIn<2> statics_one_by_one() { return statics(true); }
SimulationIn<2> statics_all_together() { return statics(false); }

SimulationIn<2> statics_with_motion() {
    Model<2> model = plate(12, 4, 1, brittle(0.03, 8));
    Physics physics;
    physics.holds = {clamp(model)};
    physics.loads = {
        driven(between(model, 11, 12), Load::Kind::displacement, {true, true, false}, {0.8, 0.2}, 1)};
    physics.statics = Statics{.duration = 1, .load_steps = 8};
    return {std::move(model), physics};
}

/// Twice Euler's load on a perfectly straight column: it leaves along its softest mode.
SimulationIn<2> statics_of_a_column() {
    Material material = test::concrete();
    material.poissons_ratio = 0;
    Model<2> model = plate(80, 4, 0.25, material);
    Physics physics;
    physics.holds = {clamp(model, 0.25)};
    const double euler = M_PI * M_PI * material.youngs_modulus / 12 / (4 * 19.75 * 19.75);
    physics.loads = {test::pull(model, between(model, 19.75, 20), {-2 * euler, 0}, 1)};
    physics.loads[0].primary = true;
    physics.statics = Statics{.duration = 1, .load_steps = 16};
    return {std::move(model), physics};
}

/// 4232 particles, so that there is more than one thread's work.
SimulationIn<2> statics_of_a_large_plate() {
    Model<2> model = plate(92, 46, 1, brittle(0.003));
    Physics physics;
    physics.holds = {clamp(model)};
    physics.loads = {test::pull(model, between(model, 91, 92), {0, -4e6}, 1)};
    physics.statics = Statics{.duration = 1, .load_steps = 3};
    return {std::move(model), physics};
}

void nothing(SimulationIn<2>&) {}
void let_go(SimulationIn<2>& simulation) {
    if (simulation.steps() == 35) simulation.stop_damping();
    if (simulation.steps() == 45) simulation.release(0);
}
void let_go_of_the_grip(SimulationIn<2>& simulation) {
    if (simulation.steps() == 65) simulation.release(0);
    if (simulation.steps() == 85) simulation.release(1);
}

struct Course {
    const char* name;
    SimulationIn<2> (*make)();
    int steps, apart, on;  ///< handed over each `apart` steps; the second then makes `on` more
    int breaks;            ///< at least so many bonds break on the way
    bool buckles = false;
    void (*act)(SimulationIn<2>&) = nothing;
};
void PrintTo(const Course& run, std::ostream* out) { *out << run.name; }

class GoOn : public testing::TestWithParam<Course> {
 protected:
    void TearDown() override { set_threads(0); }

    /// A simulation and what watches it. The monitor must see the start: it looks for a path of bonds there.
    struct Watched {
        SimulationIn<2> simulation;
        std::unique_ptr<RunMonitor> monitor;

        explicit Watched(const Course& run) : simulation(run.make()), monitor(make_run_monitor(simulation)) {}
        void step(const Course& run) {
            simulation.step();
            run.act(simulation);
            monitor->look();
            if (simulation.steps() % 3 == 0) monitor->row();
        }
    };
    struct Handed {
        std::string state, monitor;
    };
};

TEST_P(GoOn, HandedOverInMidRunItEndsWithTheSameBits) {
    const Course& run = GetParam();
    set_threads(1);
    Watched first(run);
    std::vector<Handed> all{{to_bytes(first.simulation.state()), first.monitor->state()}};
    std::vector<int> moments;
    int breaking_steps = 0;
    for (int step = 1; step <= run.steps; ++step) {
        first.step(run);
        all.push_back({to_bytes(first.simulation.state()), first.monitor->state()});
        const bool breaks = !first.simulation.just_broken().empty();
        breaking_steps += breaks;
        // the first breaks, and one later: right after a break
        if (step % run.apart == 0 || (breaks && (breaking_steps <= 2 || breaking_steps == 10)))
            moments.push_back(step);
    }
    EXPECT_GE(first.simulation.broken(), run.breaks);
    EXPECT_EQ(first.simulation.instability().has_value(), run.buckles);
    EXPECT_EQ(first.simulation.failure(), std::nullopt);

    for (std::size_t k = 0; k < moments.size(); ++k) {
        set_threads(1 + k % 2);
        Watched second(run);
        // What it did before its hand-over leaves no trace.
        for (int step = 0; k % 3 == 0 && step < 4; ++step) second.step(run);
        State<2> state;
        from_bytes(all[moments[k]].state, state);
        second.simulation.go_on_from(std::move(state));
        second.monitor->go_on_from(all[moments[k]].monitor);
        EXPECT_EQ(second.monitor->state(), all[moments[k]].monitor);
        for (int step = moments[k] + 1; step <= std::min(run.steps, moments[k] + run.on); ++step) {
            second.step(run);
            if (to_bytes(second.simulation.state()) != all[step].state) {
                State<2> expected;
                from_bytes(all[step].state, expected);
                for (const std::string& field : differing_fields(second.simulation.state(), expected))
                    ADD_FAILURE() << field << " after step " << step << ", handed over after " << moments[k];
                break;
            }
            ASSERT_EQ(second.monitor->state(), all[step].monitor)
                << "after step " << step << ", handed over after " << moments[k];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Runs, GoOn,
    testing::Values(
        Course{"LoadsDampingAndScatteredBreaks", loads_damping_and_scattered_breaks, 120, 40, 30, 10},
        Course{"ReleaseOfALoadAndEndOfDamping", loads_damping_and_scattered_breaks, 70, 10, 30, 10, false,
               let_go},
        Course{"PrescribedMotionAndGravity", motion_and_gravity, 120, 40, 30, 10},
        Course{"ReleaseOfPrescribedMotion", motion_and_gravity, 120, 10, 15, 10, false, let_go_of_the_grip},
        Course{"ThesisVariant", thesis_variant, 90, 30, 30, 10},
        Course{"StaticsOneByOne", statics_one_by_one, 60, 6, 12, 20},
        Course{"StaticsAllTogether", statics_all_together, 30, 4, 10, 20},
        Course{"StaticsWithMotion", statics_with_motion, 60, 5, 15, 10},
        Course{"StaticsOfAColumn", statics_of_a_column, 16, 1, 6, 0, true},
        Course{"StaticsOfALargePlate", statics_of_a_large_plate, 6, 2, 3, 2}),
    [](const auto& run) { return std::string(run.param.name); });

}  // namespace
}  // namespace hibi
