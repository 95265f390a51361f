#include "scene/read.hpp"

#include <gtest/gtest.h>

#include "scene/everything.hpp"
#include "scene/suggest.hpp"

namespace hibi {
namespace {

std::string small(const std::string& from, const std::string& to) {
    std::string text = small_scene;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string answer(const std::string& text, const Overrides& overrides = {}) {
    try {
        parse_scene(text, "s.toml", overrides);
    } catch (const SceneErrors& errors) {
        const std::string what = errors.what();
        return what.substr(0, what.find('\n'));
    }
    return "";
}

TEST(ReadScene, QuantitiesAreStoredInSi) {
    const Scene scene = parse_scene(small_scene, "dir/s.toml");
    EXPECT_EQ(scene.materials[0].youngs_modulus, 210e6);
    EXPECT_EQ(scene.loads[0].value[1](Vec3::Zero(), 0), -80e6);
    EXPECT_EQ(scene.loads[0].ramp, 40);
    EXPECT_EQ(scene.bodies[0].spacing(Vec3::Zero(), 0), 4);
    EXPECT_EQ(scene.run.until->event, EventName::separation);
    EXPECT_EQ(scene.run.until->offset, 0.5);
}

TEST(ReadScene, PlainNumbersAreSi) {
    EXPECT_EQ(parse_scene(small("\"-80 MN\"", "-8e7"), "s.toml").loads[0].value[1](Vec3::Zero(), 0), -80e6);
    EXPECT_EQ(parse_scene(small("\"-80 MN\"", "\"-8e7\""), "s.toml").loads[0].value[1](Vec3::Zero(), 0),
              -80e6);
}

TEST(ReadScene, FirstLoadIsPrimaryUnlessAnotherSaysSo) {
    EXPECT_TRUE(parse_scene(small_scene, "s.toml").loads[0].primary);
    const std::string second =
        "[[load]]\nwhere = \"y > 18 m - spacing\"\nforce = [1, 0]\nprimary = true\n[run]";
    const Scene scene = parse_scene(small("[run]", second), "s.toml");
    EXPECT_FALSE(scene.loads[0].primary);
    EXPECT_TRUE(scene.loads[1].primary);
    EXPECT_EQ(scene.loads[1].name, "load2");
}

TEST(ReadScene, ParametersMayUseThoseBeforeThem) {
    const std::string text =
        small("spacing = \"4 m\"", "side = \"8 m\"\nspacing = \"side / 2\"\nE = \"1 MPa\"");
    EXPECT_EQ(parse_scene(text, "s.toml").params[1].value, 4);
    EXPECT_EQ(answer(small("spacing = \"4 m\"", "spacing = \"side / 2\"\nside = \"8 m\"")),
              "s.toml:4:12: error: [params] spacing: unknown name \"side\"");
    EXPECT_EQ(answer(small("spacing = \"4 m\"", "spacing = \"4 m\"\nx = \"1 m\"")),
              "s.toml:5:1: error: [params] x: the name has a meaning of its own in expressions");
}

TEST(ReadScene, WholeNumbersMayBeExpressions) {
    const auto with = [](const std::string& fps) {
        return small("[run]", "[movie]\nfps = " + fps + "\n[run]");
    };
    EXPECT_EQ(parse_scene(with("\"5 * spacing / (1 m)\""), "s.toml").movie.fps, 20);
    EXPECT_EQ(answer(with("\"spacing / (1.5 m)\"")).substr(0, 66),
              "s.toml:25:7: error: [movie] fps needs a whole number; found 2.6666");
    EXPECT_EQ(answer(with("2.5")), "s.toml:25:7: error: [movie] fps needs a whole number; found a number");
}

TEST(ReadScene, MaxTimeIsNotNeededWhereUntilIsATime) {
    const std::string text = small("until = \"separation + 0.5 s\"\nmax_time = \"60 s\"", "until = \"2 ms\"");
    EXPECT_EQ(parse_scene(text, "s.toml").run.max_time, 0.002);
    EXPECT_EQ(answer(small("max_time = \"60 s\"", "")),
              "s.toml:24:1: error: missing key \"max_time\" in [run]");
}

TEST(ReadScene, QuasiStaticDampingIsARatioUntilSeparationWhereThereMayBeOne) {
    const std::string line = "damping = \"quasi-static\"\n";
    const Scene scene = parse_scene(line + small_scene, "s.toml");
    ASSERT_TRUE(scene.damping);
    EXPECT_EQ(scene.damping->damping.ratio, 0.3);
    ASSERT_TRUE(scene.damping->until);
    EXPECT_EQ(scene.damping->until->event, EventName::separation);
    EXPECT_NE(write_scene(scene).find("[damping]\nratio = 0.3\nuntil = \"separation\"\n"), std::string::npos);

    std::string lasting = small("break_strain = 0.1\n", "");
    lasting.replace(lasting.find("until = \"separation + 0.5 s\"\n"), 29, "");
    EXPECT_FALSE(parse_scene(line + lasting, "s.toml").damping->until);
}

TEST(Overrides, ReplaceAParameterAndWhatFollowsFromIt) {
    const std::string text = small("spacing = \"4 m\"", "side = \"8 m\"\nspacing = \"side / 2\"");
    EXPECT_EQ(parse_scene(text, "s.toml", {{"side", "4 m"}}).bodies[0].spacing(Vec3::Zero(), 0), 2);
    EXPECT_EQ(parse_scene(text, "s.toml", {{"side", "400cm"}}).params[1].value, 2);
    EXPECT_EQ(parse_scene(text, "s.toml", {{"side", "4"}}).params[1].value,
              2);  // SI, of the parameter's dimension
    EXPECT_EQ(parse_scene(text, "s.toml", {{"spacing", "side"}, {"side", "2 m"}}).params[1].value, 2);
}

TEST(Overrides, ThatDoNotFitAreMistakesOfTheCommandLine) {
    EXPECT_EQ(
        answer(small_scene, {{"spacng", "2 m"}}),
        "s.toml: error: -p spacng=2 m: this scene has no parameter \"spacng\"; did you mean \"spacing\"?");
    EXPECT_EQ(answer(small_scene, {{"width", "2 m"}}),
              "s.toml: error: -p width=2 m: this scene has no parameter \"width\"; known: spacing");
    EXPECT_EQ(answer(small_scene, {{"spacing", "2 MPa"}}),
              "s.toml: error: -p spacing=2 MPa: spacing is a length; \"2 MPa\" is a pressure");
    EXPECT_EQ(answer(small_scene, {{"spacing", "2 q"}}).substr(0, 49),
              "s.toml: error: -p spacing=2 q: unknown unit \"q\"; ");
}

TEST(ReadScene, SelectionsAndLoadsMayNameABody) {
    const Scene scene = parse_scene(everything, "s.toml");
    EXPECT_EQ(scene.fixes[1].where.body, 5);
    EXPECT_TRUE(scene.fixes[1].where(Vec3(61, 1, 0), 1, 5));
    EXPECT_FALSE(scene.fixes[1].where(Vec3(61, 1, 0), 1, 4));
    EXPECT_EQ(answer(small("hold =", "body = \"plat\"\nhold =")), "s.toml:18:8: error: no body \"plat\"");
}

TEST(ReadScene, EveryRuleOfALoadIsChecked) {
    EXPECT_EQ(answer(small("ramp =", "pressure = 3\nramp =")),
              "s.toml:23:12: error: [[load]] has both force and pressure");
    EXPECT_EQ(answer(small("force = [\"0 N\", \"-80 MN\"]", "")),
              "s.toml:19:1: error: [[load]] needs a value: \"force\", \"pressure\", \"displacement\" or "
              "\"velocity\"");
    EXPECT_EQ(
        answer(small("[\"0 N\", \"-80 MN\"]", "\"80 MN\"")),
        "s.toml:22:9: error: [[load]] force needs a list of 2 entries, one per axis (N); found \"80 MN\"");
    EXPECT_EQ(answer(small("[\"0 N\", \"-80 MN\"]", "[\"0 N\", \"-80 MN\", \"0 N\"]")),
              "s.toml:22:9: error: [[load]] force needs a list of 2 entries, one per axis (N); found 3");
    EXPECT_EQ(answer(small("\"-80 MN\"", "\"-80 MN/x*(1 m)*s\"")),
              "s.toml:22:33: error: [[load]] force: unknown name \"s\"");
    EXPECT_EQ(answer(small("\"-80 MN\"", "\"-80 MN*(1 m)/(x - 38 m)\"")),
              "s.toml:22:9: error: [[load]] force is not finite at (38 m, 2 m), t = 0 s");
    EXPECT_EQ(answer(small("where = \"x > 40 m - spacing\"", "face = \"up\"")),
              "s.toml:21:8: error: [[load]] face: no \"up\"");
    EXPECT_EQ(answer(small("force = [\"0 N\", \"-80 MN\"]", "pulse = {}")),
              "s.toml:22:1: error: [[load]] pulse: not available yet");
    EXPECT_EQ(answer(small("x > 40 m - spacing\"\nforce = [\"0 N\", \"-80 MN\"]",
                           "x < spacing\"\ndisplacement = [\"1 mm\", \"free\"]")),
              "s.toml:19:1: error: [[load]]: \"tip\" and \"clamp\" both prescribe the x of the particle at "
              "(2 m, 2 m)");
}

TEST(ReadScene, LimitsOfATestAreThoseGivenAndNoneIsNegative) {
    const std::string scene = std::string(small_scene) + "[test]\n";
    const TestLimits limits =
        parse_scene(scene + "tolerance = { break_steps = 2, load = 0.01 }\n", "s.toml").test.tolerance;
    EXPECT_EQ(limits.break_steps, 2);
    EXPECT_EQ(limits.load, 0.01);
    EXPECT_FALSE(limits.tile);
    EXPECT_EQ(answer(scene + "tolerance = { tile = -1 }\n"),
              "s.toml:28:22: error: [test] tolerance tile needs to be from 0 to 1e9; found -1");
    EXPECT_EQ(
        answer(scene + "tolerance = { break_steps = 9999999999 }\n").find("s.toml:28:29: error: [test] "),
        0u);
    EXPECT_EQ(answer(scene + "tolerance = { tiel = 1 }\n").find("s.toml:28:15: error: unknown key \"tiel\""),
              0u);
}

TEST(Suggestions, FindTheNearestNameAndNoFarOne) {
    const std::vector<std::string> known{"friction", "ramp", "until"};
    EXPECT_EQ(nearest("frction", known), "friction");
    EXPECT_EQ(nearest("rmap", known), "ramp");
    EXPECT_EQ(nearest("untill", known), "until");
    EXPECT_FALSE(nearest("spacing", known));
    EXPECT_FALSE(nearest("", known));
    EXPECT_FALSE(nearest(std::string(1000000, 'a'), known));
}

}  // namespace
}  // namespace hibi
