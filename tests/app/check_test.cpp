#include "app/check.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/new.hpp"
#include "scene/built_in_scenes.hpp"
#include "scene/everything.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

const std::filesystem::path fine = HIBI_SOURCE_DIR "/scenes/bending_fine.toml";

std::string report(bool json, const Overrides& overrides = {}) {
    testing::internal::CaptureStdout();
    EXPECT_EQ(check_command({fine, overrides, json}), 0);
    std::fflush(stdout);
    return testing::internal::GetCapturedStdout();
}

TEST(Check, PrintsCountsStagesAndEveryDefault) {
    const std::string text = report(false);
    for (const char* part :
         {"particles   800\n", "bonds       4502\n",
          "body        plate: concrete, 800 particles of 1 m, 1.84e+06 kg; area and mass +0.00 %\n",
          "support     clamp: 20 particles held in x and y\n",
          "load        tip: force (0 N, -80 MN) on 20 particles; full after 40 s; drives the curve\n",
          "each step   1. ", "influence = 2.1\n", "theme = \"dark\"\n", "at most     "})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

TEST(Check, JsonHoldsTheSameNumbers) {
    const auto json = nlohmann::json::parse(report(true, {{"spacing", "2 m"}}));
    EXPECT_EQ(json["counts"]["particles"], 200);
    EXPECT_EQ(json["scene"]["hash"], scene_hash(read_scene(fine, {{"spacing", "2 m"}})));
    EXPECT_GT(json["stages"].size(), 2u);
    EXPECT_GT(json["stable_time_step"].get<double>(), json["time_step"].get<double>());
    EXPECT_GT(json["estimate"]["steps"].get<int>(), 1000);
    EXPECT_EQ(json["notes"].size(), 1u) << json["notes"];
}

class CheckOf : public testing::Test {
 protected:
    nlohmann::json of(const std::string& scene, CheckOptions options = {}) {
        options.scene = folder_.path() / "s.toml";
        options.json = true;
        std::ofstream(options.scene) << scene;
        testing::internal::CaptureStdout();
        EXPECT_EQ(check_command(options), 0);
        std::fflush(stdout);
        return nlohmann::json::parse(testing::internal::GetCapturedStdout());
    }
    static std::string with(const std::string& from, const std::string& to) {
        std::string text = small_scene;
        return text.replace(text.find(from), from.size(), to);
    }
    const TemporaryFolder folder_;
};

bool has_note(const nlohmann::json& json, const std::string& words);

TEST_F(CheckOf, RemarksThatABrittleMaterialIsCrushedAsSoonAsItIsTorn) {
    const std::string words = "bonds that are shortened by 0.01 % break too";
    EXPECT_TRUE(has_note(of(with("break_strain = 0.1", "break_strain = 0.0001")), words));
    EXPECT_FALSE(
        has_note(of(with("break_strain = 0.1", "break_strain = 0.0001\ntension_only = true")), "shortened"));
    EXPECT_FALSE(has_note(of(small_scene), "shortened"));
}

TEST_F(CheckOf, RemarksThatGravityActsFromTheStart) {
    EXPECT_TRUE(has_note(of(with("[run]", "[gravity]\n[run]")), "gravity acts from the start"));
    EXPECT_FALSE(has_note(of(small_scene), "gravity"));
}

bool has_note(const nlohmann::json& json, const std::string& words) {
    return std::ranges::any_of(json["notes"], [&](const auto& note) {
        return note.template get<std::string>().find(words) != std::string::npos;
    });
}

TEST_F(CheckOf, AStaticSceneHasNeitherStableTimeStepNorFastRamps) {
    EXPECT_TRUE(of(small_scene)["stable_time_step"].is_number());
    const std::string fast = with("ramp = \"40 s\"", "ramp = \"1 s\"");
    EXPECT_TRUE(has_note(of(fast), "first period"));
    const auto json = of(fast + "method = \"static\"\n");
    EXPECT_TRUE(json["stable_time_step"].is_null());
    EXPECT_TRUE(json["first_period"].is_null());
    EXPECT_FALSE(has_note(json, "first period") || has_note(json, "first mode")) << json["notes"];
    EXPECT_NEAR(json["time_step"].get<double>(), 60.0 / 50, 1e-12);
}

TEST_F(CheckOf, SaysWhereTheFirstModeWouldTakeTooLong) {
    const std::string words = "the first mode was not looked for, so ramps are not judged: 50 particles";
    const auto at = of(small_scene, {.most_particles_for_period = 50});
    EXPECT_TRUE(at["first_period"].is_number());
    EXPECT_FALSE(has_note(at, words)) << at["notes"];
    const auto beyond = of(small_scene, {.most_particles_for_period = 49});
    EXPECT_TRUE(beyond["first_period"].is_null());
    EXPECT_TRUE(has_note(beyond, words)) << beyond["notes"];
    // Damped by a ratio, the run needs it anyhow.
    const auto damped =
        of("damping = \"quasi-static\"\n" + std::string(small_scene), {.most_particles_for_period = 49});
    EXPECT_EQ(damped["first_period"], at["first_period"]);
    EXPECT_FALSE(has_note(damped, words)) << damped["notes"];
}

TEST_F(CheckOf, RemarksThatABreakStrainAtAClampOrNotchDependsOnTheSpacing) {
    EXPECT_TRUE(has_note(of(small_scene), "break_strain: the strain at the support \"clamp\" grows"));
    const std::string notch = "[[notch]]\nline = [[\"20 m\", \"20 m\"], [\"20 m\", \"10 m\"]]\n";
    EXPECT_TRUE(has_note(of(small_scene + notch), "break_strain: the strain at the tip of a notch grows"));
    const std::string words = "break_strain: ";
    EXPECT_FALSE(has_note(of(with("break_strain = 0.1", "fracture_energy = 100")), words));
    EXPECT_FALSE(has_note(of(with("hold = [\"x\", \"y\"]", "hold = [\"x\"]")), words));
}

/// What `hibi check` says of a scene in text.
std::string report_on(const std::string& bodies) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "s.toml";
    std::ofstream(file) << R"(version = 1
title = "s"
[material.m]
density = 1
youngs_modulus = 1
poissons_ratio = 0.3
)" << bodies << "[gravity]\nacceleration = [0, -1]\n[run]\nmax_time = 1\n";
    testing::internal::CaptureStdout();
    EXPECT_EQ(check_command({file, {}, false}), 0);
    std::fflush(stdout);
    return testing::internal::GetCapturedStdout();
}

TEST(Check, TellsMassAndCentreErrorsAndBondsThatWouldCrossEmptySpace) {
    // Of 3.5 columns four are filled: their centre of mass is 2, the centroid 1.75.
    const std::string text = report_on(R"(
[[body]]
material = "m"
polygon = [[0, 0], [3.5, 0], [3.5, 6], [0, 6]]
spacing = 1
[[body]]
material = "m"
polygon = [[10, 0], [20, 0], [20, 4], [12, 4], [12, 5], [20, 5], [20, 9], [10, 9]]
spacing = 1
[[body]]
material = "m"
box = [[20.6, 0], [24.6, 4]]
spacing = 1
bonded_to = ["body2"]
)");
    for (const char* part : {"area and mass +14.29 %, centre of mass off by (0.25, 0.00) spacings\n",
                             "82 particles of 1 m, 82 kg; area and mass +0.00 %\n",
                             " not made, for they would cross empty space\n",
                             "body \"body3\": bonded_to holds \"body2\", but no bond joins the two"})
        EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
}

class New : public testing::Test {
 protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() / ("hibi_new_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder_);
        testing::internal::CaptureStdout();
        testing::internal::CaptureStderr();
    }
    void TearDown() override {
        testing::internal::GetCapturedStdout();
        testing::internal::GetCapturedStderr();
        std::filesystem::remove_all(folder_);
    }
    std::filesystem::path folder_;
};

TEST_F(New, WritesAStarterThatIsARightScene) {
    EXPECT_EQ(new_command({folder_ / "first", "", false}), 0);
    const Scene scene = read_scene(folder_ / "first.toml");
    EXPECT_EQ(scene.title, "A notched beam, bent until it breaks");
    EXPECT_GT(build(scene).model.bonds_cut, 0);
}

TEST_F(New, CopiesABuiltInSceneToTheByteBelowItsFirstLine) {
    EXPECT_EQ(new_command({folder_ / "copy.toml", "bending_fine", false}), 0);
    const auto read = [](const std::filesystem::path& file) {
        std::ifstream in(file, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    const std::string text = read(fine);
    ASSERT_TRUE(text.starts_with("#:schema ../build/release/scene.schema.json\n"));
    EXPECT_EQ(read(folder_ / "copy.toml"), text.substr(text.find('\n') + 1));  // no schema beside this test
}

TEST_F(New, NeverOverwritesAndKnowsItsScenes) {
    std::ofstream(folder_ / "mine.toml") << "precious";
    EXPECT_EQ(new_command({folder_ / "mine", "", false}), 2);
    EXPECT_EQ(std::filesystem::file_size(folder_ / "mine.toml"), 8u);
    EXPECT_EQ(new_command({folder_ / "other", "bending_fien", false}), 2);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "other.toml"));
    EXPECT_EQ(built_in_scenes().front().first, "bending_coarse");
}

}  // namespace
}  // namespace hibi
