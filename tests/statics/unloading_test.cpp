#include <gtest/gtest.h>

#include <cmath>

#include "simulation/simulation.hpp"
#include "statics/equilibrium.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

using test::plate;
using test::where;

Material brittle(double strain) {
    Material m = test::concrete();
    m.break_strain = strain;
    return m;
}

Hold clamp(const Model<2>& model, double reach = 1) {
    return {"clamp", where(model, [&](const Vec<2>& X) { return X.x() < reach; }), {true, true, false}};
}

std::vector<int> right_end(const Model<2>& model) {
    double right = 0;
    for (const Vec<2>& X : model.particles.reference_position) right = std::max(right, X.x());
    return where(model, [&](const Vec<2>& X) { return X.x() > right - 0.1; });
}

/// A load over time that has gone at its end.
struct Course {
    const char* name;
    double (*share)(double t);
};
void PrintTo(const Course& c, std::ostream* out) { *out << c.name; }

class Unloading : public testing::TestWithParam<Course> {
 protected:
    static Load course(const Model<2>& model, double peak, Load::Kind kind) {
        Load load = test::pull(model, right_end(model), {0, -1}, 0);
        load.kind = kind;
        load.value = {
            Field(0.0),
            Field([peak, share = GetParam().share](const Vec3&, double t) { return -peak * share(t); }, false,
                  true, ""),
            Field(0.0)};
        if (kind == Load::Kind::displacement) load.driven = {false, true, false};
        return load;
    }
    static Physics held(const Model<2>& model, const Load& load, int load_steps) {
        Physics physics;
        physics.holds = {clamp(model)};
        physics.loads = {load};
        physics.statics = Statics{.duration = 1, .load_steps = load_steps};
        return physics;
    }
    /// Runs to the end. Returns the largest displacement that is left.
    static double left_over(SimulationIn<2>& simulation) {
        while (simulation.time() < 1 && !simulation.collapse()) simulation.step();
        EXPECT_FALSE(simulation.collapse()) << *simulation.collapse();
        double most = 0;
        for (const Vec<2>& u : simulation.state().displacement) most = std::max(most, u.norm());
        return most;
    }
};

TEST_P(Unloading, EndsAtRestWhateverTheStepsAndTheSizeOfTheLoad) {
    for (const int load_steps : {2, 8, 9, 10, 12, 20, 21, 50, 100}) {
        for (const double force : {1e-12, 1e5, 1e6}) {
            const Model<2> model = plate(10, 4, 1);
            SimulationIn<2> simulation(model, held(model, course(model, force, Load::Kind::force), load_steps));
            EXPECT_LE(left_over(simulation), 1e-18 * force) << load_steps << " steps, " << force << " N";
        }
    }
}

TEST_P(Unloading, OfAPrescribedMotionEndsAtRest) {
    for (const int load_steps : {8, 10, 50, 100}) {
        const Model<2> model = plate(10, 4, 1);
        SimulationIn<2> simulation(model,
                                 held(model, course(model, 0.1, Load::Kind::displacement), load_steps));
        EXPECT_LE(left_over(simulation), 1e-15) << load_steps;
    }
}

TEST_P(Unloading, AfterBreaksEndsAtRest) {
    const Model<2> model = plate(10, 4, 1, brittle(2e-3));
    SimulationIn<2> simulation(model, held(model, course(model, 0.05, Load::Kind::displacement), 20));
    left_over(simulation);
    EXPECT_GT(simulation.broken(), 0);
}

TEST_P(Unloading, UnderGravityEndsWhereGravityAloneLeadsTo) {
    const Model<2> model = plate(10, 4, 1);
    Physics physics = held(model, course(model, 1e5, Load::Kind::force), 20);
    physics.gravity = Gravity{{0, -9.81, 0}};
    SimulationIn<2> there_and_back(model, physics);
    left_over(there_and_back);
    physics.loads.clear();
    SimulationIn<2> never_loaded(model, physics);
    const double most = left_over(never_loaded);
    for (int i = 0; i < model.particles.count(); ++i)
        EXPECT_LE((there_and_back.state().displacement[i] -
                   never_loaded.state().displacement[i])
                      .norm(),
                  1e-9 * most);
}

INSTANTIATE_TEST_SUITE_P(
    Course, Unloading,
    testing::Values(Course{"triangle", [](double time) { return 1 - std::abs(2 * time - 1); }},
                    Course{"gone_at_half_time", [](double time) { return std::max(0.0, 1 - 2 * time); }},
                    Course{"sine", [](double time) { return std::sin(3.14159265358979 * time); }},
                    Course{"dropped", [](double time) { return time < 0.5 ? 1.0 : 0.0; }}),
    [](const auto& course) { return course.param.name; });

// Far smaller than what rounding leaves of the load before: it is found to its own accuracy all the same.
TEST(UnloadingOnce, ToATinyLoadFindsItsEquilibriumToAllDigits) {
    const Model<2> model = plate(10, 4, 1);
    State<2> state = initial_state(model);
    std::vector<std::array<bool, 3>> held(model.particles.count());
    for (const int i : clamp(model).particles) held[i] = {true, true, true};
    const auto law = make_elastic_law<2>(model, Elasticity::moment_matched);
    Equilibrium<2> equilibrium(model, *law, state, held);
    std::vector<Vec<2>> applied(model.particles.count(), Vec<2>::Zero());
    const int tip = right_end(model).front();
    for (const double force : {1e5, 1e-9}) {
        applied[tip] = {0, force};
        ASSERT_TRUE(equilibrium.find(state, {applied, {}}).found);
    }
    const double found = state.displacement[tip].y();
    for (Vec<2>& u : state.displacement) u.setZero();
    ASSERT_TRUE(equilibrium.find(state, {applied, {}}).found);
    EXPECT_NEAR(found / state.displacement[tip].y(), 1, 1e-8);
}

}  // namespace
}  // namespace hibi
