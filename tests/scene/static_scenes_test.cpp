#include <gtest/gtest.h>

#include "simulation/simulation.hpp"
#include "scene/build.hpp"
#include "scene/everything.hpp"
#include "scene/read.hpp"

namespace hibi {
namespace {

std::string with(const std::string& keys, const std::string& from = "", const std::string& to = "") {
    std::string text = small_scene;
    text += keys;
    if (!from.empty()) text.replace(text.find(from), from.size(), to);
    return text;
}

/// What reading and building a scene is answered; "" for a right one.
std::string answer(const std::string& text) {
    try {
        build(parse_scene(text, "s.toml"));
    } catch (const SceneErrors& errors) {
        return errors.what();
    }
    return "";
}

TEST(StaticScene, ReadsItsKeysAndWritesThemBack) {
    EXPECT_FALSE(parse_scene(small_scene, "s.toml").run.statics);
    const Scene plain = parse_scene(with("method = \"static\"\n"), "s.toml");
    ASSERT_TRUE(plain.run.statics);
    EXPECT_EQ(plain.run.statics->load_steps, 50);
    EXPECT_TRUE(plain.run.statics->sequential);
    const Scene scene =
        parse_scene(with("method = \"static\"\nload_steps = 7\nbreaking = \"together\"\n"), "s.toml");
    const Scene again = parse_scene(write_scene(scene), "again");
    EXPECT_EQ(scene_hash(scene), scene_hash(again));
    EXPECT_EQ(again.run.statics->load_steps, 7);
    EXPECT_FALSE(again.run.statics->sequential);
    const Physics physics = build(scene).physics;
    ASSERT_TRUE(physics.statics);
    EXPECT_EQ(physics.statics->step(), 60.0 / 7);
}

TEST(StaticScene, RefusesWhatHasNoMeaningWithoutMotion) {
    const std::string statics = "method = \"static\"\n";
    EXPECT_EQ(answer(with(statics)), "");
    const auto expect = [&](const std::string& text, const std::string& message) {
        EXPECT_NE(answer(text).find(message), std::string::npos) << answer(text);
    };
    expect(with(statics + "[damping]\nratio = 0.3\n"),
           "[damping]: [run] method = \"static\" knows no motion");
    expect(with(statics + "time_step = 1e-3\n"), "[run] time_step: [run] method");
    expect(with(statics + "[model]\nelasticity = \"thesis\"\n"),
           "[model] elasticity: method = \"static\" is for");
    expect(with(statics, "spacing = \"spacing\"\n", "spacing = \"spacing\"\nspin = 1\n"),
           "body \"plate\" has a velocity or spin: [run] method");
    expect(with(statics, "ramp = ", "until = 3\nramp = "), "[[load]] until: [run] method");
    expect(with(statics, "force = [\"0 N\", \"-80 MN\"]", "velocity = [\"free\", 1]"),
           "[[load]] velocity: [run] method");
    expect(with(statics, "hold = [\"x\", \"y\"]", "hold = [\"x\"]"),
           "can move freely, so it has no equilibrium");
    expect(with("load_steps = 3\n"), "[run] load_steps goes with method = \"static\"");
    expect(with("breaking = \"together\"\n"), "[run] breaking goes with method = \"static\"");
    expect(with(statics + "load_steps = 0\n"), "[run] load_steps needs to be from 1 to 1000000; found 0");
}

TEST(StaticScene, ItsStepHoldsOnlyWhatItAsksFor) {
    Built<2> built = build(parse_scene(with("method = \"static\"\n"), "s.toml"));
    const SimulationIn<2> simulation(built.model, built.physics);
    EXPECT_EQ(simulation.stage_names(),
              (std::vector<std::string>{"raise loads, to the next load step or to the first break",
                                        "equilibrium (Newton, moment-matched)",
                                        "break the bond furthest beyond its limit"}));
    built.model.materials[0].break_strain.reset();
    const SimulationIn<2> unbreakable(built.model, built.physics);
    EXPECT_EQ(unbreakable.stage_names(), (std::vector<std::string>{"raise loads to the next load step",
                                                                   "equilibrium (Newton, moment-matched)"}));
}

}  // namespace
}  // namespace hibi
