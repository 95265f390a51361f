#include "solve/run_to_end.hpp"

#include <gtest/gtest.h>

#include "scene/read.hpp"

namespace hibi {
namespace {

/// A column that hangs from its upper end and is pulled down at the lower one.
BuiltScene hanging(const std::string& run, const std::string& load = "") {
    const Scene scene = parse_scene(R"(
version = 1
[material.rubber]
density = "1000 kg/m^3"
youngs_modulus = "1 MPa"
poissons_ratio = 0.3
break_strain = 0.5
[[body]]
name = "column"
material = "rubber"
box = [["0 m", "0 m"], ["2 m", "6 m"]]
spacing = "1 m"
[[fix]]
name = "top"
where = "y > 5 m"
hold = ["x", "y"]
[[load]]
name = "weight"
where = "y < 1 m"
force = ["0 N", "-10 N"]
)" + load + "\n[run]\n" + run + "\n",
                                    "hanging.toml");
    return {scene, build(scene)};
}

struct Steps {
    explicit Steps(BuiltScene setup)
        : scene(std::move(setup.scene)),
          simulation(std::move(setup.built.model), std::move(setup.built.physics)),
          monitor(make_run_monitor(simulation)) {}

    Scene scene;
    SimulationIn<2> simulation;
    std::unique_ptr<RunMonitor> monitor;
};

TEST(RunToEnd, CallsBackAfterEachStepUntilTheSceneEnds) {
    Steps s(hanging(R"(max_time = "1 s")"));
    std::int64_t calls = 0;
    const auto obstacle = run_to_end(s.scene, s.simulation, *s.monitor, [&]() -> std::optional<std::string> {
        ++calls;
        EXPECT_EQ(s.simulation.steps(), calls);
        EXPECT_EQ(s.monitor->events().end, s.simulation.time()) << "the monitor has looked";
        return {};
    });
    EXPECT_FALSE(obstacle);
    EXPECT_EQ(calls, s.simulation.steps());
    EXPECT_GE(s.simulation.time(), 1);
    EXPECT_LT(s.simulation.time() - s.simulation.time_step(), 1);
}

TEST(RunToEnd, StopsWhereTheCallerSaysSo) {
    Steps s(hanging(R"(max_time = "1 s")"));
    const auto obstacle = run_to_end(s.scene, s.simulation, *s.monitor, [&]() -> std::optional<std::string> {
        if (s.simulation.steps() == 3) return "enough";
        return {};
    });
    EXPECT_EQ(obstacle, "enough");
    EXPECT_EQ(s.simulation.steps(), 3);
}

TEST(RunToEnd, ReleasesALoadAtItsMomentBeforeTheCallerLooks) {
    Steps s(hanging(R"(max_time = "1 s")", R"(until = "0.5 s")"));
    int loaded = 0, released = 0;
    run_to_end(s.scene, s.simulation, *s.monitor, [&]() -> std::optional<std::string> {
        const bool before = s.simulation.time() < 0.5;
        EXPECT_EQ(s.monitor->row().load, before ? 10 : 0) << s.simulation.time();
        ++(before ? loaded : released);
        return {};
    });
    EXPECT_GT(loaded, 0);
    EXPECT_GT(released, 0);
}

TEST(RunToEnd, ASceneThatWaitsForASeparationNeedsSomethingThatHolds) {
    const BuiltScene setup = hanging("until = \"separation\"\nmax_time = \"1 s\"");
    const SimulationIn<2> held(setup.built.model, setup.built.physics);
    EXPECT_NO_THROW(require_separable(setup.scene, *make_run_monitor(held)));
    Scene scene = setup.scene;
    Physics physics = setup.built.physics;
    physics.holds.clear();
    const SimulationIn<2> free(setup.built.model, physics);
    EXPECT_THROW(require_separable(scene, *make_run_monitor(free)), SceneErrors);
    scene.run.until.reset();
    EXPECT_NO_THROW(require_separable(scene, *make_run_monitor(free)));
}

TEST(RunToEnd, ARunOfMoreStepsThanAnyoneCanWaitForIsRefused) {
    const BuiltScene setup = hanging(R"(max_time = "1 s")");
    const SimulationIn<2> simulation(setup.built.model, setup.built.physics);
    EXPECT_NO_THROW(require_steps_that_end(setup.scene, simulation));
    Scene scene = setup.scene;
    scene.run.max_time = 1.1e9 * simulation.time_step();
    EXPECT_THROW(require_steps_that_end(scene, simulation), SceneErrors);
}

}  // namespace
}  // namespace hibi
