#include "app/check.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "app/new.hpp"

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
    EXPECT_TRUE(json["notes"].empty());
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
