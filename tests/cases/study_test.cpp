// Studies as a user calls them, with runs of a fraction of a second.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/call.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Answer hibi(const std::string& arguments) { return call(HIBI_PROGRAM " " + arguments); }

Json read(const fs::path& file) { return Json::parse(std::ifstream(file)); }

const std::string bending = HIBI_SOURCE_DIR "/scenes/bending_coarse.toml";

TEST(Sweep, RunsAllCombinationsOnceAndGoesOnWhereOneFails) {
    const TemporaryFolder folder;
    const fs::path study = folder.path() / "study";
    // 3 m does not divide the plate's 40 m: that run is refused before any is started ...
    const Answer wrong = hibi("sweep " + bending + " -q -p spacing=4m,3m -o " + study.string());
    EXPECT_EQ(wrong.status, 2) << wrong.out;
    EXPECT_FALSE(fs::exists(study));
    // ... and the scene of the coarse plate is changed so that one run blows up.
    const fs::path scene = folder.path() / "step.toml";
    std::ifstream in(bending);
    std::string text(std::istreambuf_iterator<char>(in), {});
    text.replace(text.find("[params]"), 8, "[params]\nfactor = 0.5");
    text.replace(text.find("[run]"), 5, "[run]\ntime_step_factor = \"factor\"");
    std::ofstream(scene) << text;
    const std::string command =
        "sweep " + scene.string() + " -q -p spacing=4m,5m -p factor=0.5,0.4 -o " + study.string();
    const Answer first = hibi(command);
    EXPECT_EQ(first.status, 0) << first.out;
    Json rows = read(study / "sweep.json")["runs"];
    ASSERT_EQ(rows.size(), 4u);
    for (const Json& row : rows) {
        EXPECT_EQ(row["status"], "done");
        const Json run = read(fs::path(row["folder"].get<std::string>()) / "run.json");
        EXPECT_EQ(row["first_break_load"], run["events"]["first_break"]["load"]);
        EXPECT_EQ(row["particles"], run["counts"]["particles"].get<double>());
    }
    EXPECT_NEAR(rows[0]["first_break_load"].get<double>() / 5.80e7, 1, 0.02);
    for (const char* name : {"sweep.csv", "sheet.png", "plot.png", "plot.svg"})
        EXPECT_TRUE(fs::exists(study / name)) << name;
    for (const char* line : {"table            ", "plot             ", "sheet            "})
        EXPECT_NE(first.out.find("\n" + std::string(line) + study.string() + "/"), std::string::npos)
            << first.out;
    EXPECT_TRUE(first.out.ends_with("/sheet.png\n")) << first.out;
    EXPECT_EQ(hibi("reproduce " + (study / "sweep.csv").string()).out.substr(0, 10), "hibi sweep");

    // Again: what is there is kept, what is damaged is run once more.
    const auto stamp = [&](int k) {
        return fs::last_write_time(fs::path(rows[k]["folder"].get<std::string>()) / "run.json");
    };
    const auto kept = stamp(0), renewed = stamp(1);
    const fs::path second = fs::path(rows[1]["folder"].get<std::string>()) / "run.json";
    Json unfinished = read(second);
    unfinished["stopped"] = "it was killed";
    std::ofstream(second) << unfinished;
    fs::last_write_time(second, renewed);
    const Answer again = hibi(command);
    EXPECT_EQ(again.status, 0) << again.out;
    EXPECT_EQ(stamp(0), kept);
    EXPECT_NE(stamp(1), renewed);
    EXPECT_TRUE(read(second)["stopped"].is_null());
}

TEST(Sweep, ARunThatFailsIsToldAndStopsNoOther) {
    const TemporaryFolder folder;
    const fs::path study = folder.path() / "study";
    // A file stands where the folder of the first run should be.
    fs::create_directories(study / "spacing=5m");
    std::ofstream(study / "spacing=4m") << "in the way";
    const Answer answer = hibi("sweep " + bending + " -q --force -p spacing=4m,5m -o " + study.string());
    EXPECT_EQ(answer.status, 1) << answer.out;
    EXPECT_NE(answer.out.find("failed: "), std::string::npos) << answer.out;
    const Json rows = read(study / "sweep.json")["runs"];
    EXPECT_EQ(rows[0]["status"], "failed");
    EXPECT_FALSE(rows[0]["error"].is_null());
    EXPECT_EQ(rows[1]["status"], "done");
}

TEST(Converge, ShowsBothCriteriaFromCoarseToFineAndWarns) {
    const TemporaryFolder folder;
    const fs::path study = folder.path() / "study";
    const Answer answer =
        hibi("converge " + bending + " -q --no-movie -p spacing=2m,4m -o " + study.string());
    EXPECT_EQ(answer.status, 0) << answer.out;
    EXPECT_NE(answer.out.find("warning: With fixed strain the load at first break moves by −26"),
              std::string::npos)
        << answer.out;
    const Json rows = read(study / "converge.json")["runs"];
    ASSERT_EQ(rows.size(), 4u);
    EXPECT_EQ(rows[0]["particles"], 50);
    EXPECT_EQ(rows[1]["particles"], 200);
    EXPECT_EQ(rows[2]["criterion"], "fracture energy");
    EXPECT_NEAR(rows[0]["first_break_load"].get<double>() / 5.80e7, 1, 0.02);
    EXPECT_NEAR(rows[1]["first_break_load"].get<double>() / 4.25e7, 1, 0.02);
    EXPECT_EQ(rows[2]["first_break_load"], rows[0]["first_break_load"]) << "the same limit at the coarsest";
    EXPECT_EQ(rows[0]["mode"], "on the upper left in tension");
    for (const char* name : {"converge.csv", "plot.png", "plot.svg", "sheet.png", "caption.md"})
        EXPECT_TRUE(fs::exists(study / name)) << name;
}

}  // namespace
}  // namespace hibi
