#include "record/summary.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "record/example.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

using example::message_of;
using nlohmann::json;

RunSummary full_summary() {
    RunSummary s;
    s.title = "板の曲げ";
    s.scene_hash = "abc";
    s.scene_file = "scenes/bending.toml";
    s.version = "0.1.0";
    s.particles = 1;
    s.bonds = 2;
    s.broken = 3;
    s.frames = 4;
    s.threads = 5;
    s.dimension = 3;
    s.steps = 6'000'000'000;  // beyond 32 bits
    s.time_step = 1.0 / 3;
    s.end_time = 0.1;
    s.events.first_break = Event{1, 2, 3, Vec3(4, 5, 6)};
    s.events.end = 0.1;
    s.crack = {0.2, Vec3(7, 8, 9), 10};
    s.top_crack_speed = 11;
    s.fragments = {12, 13, 14};
    s.worst_imbalance = 1e-5;
    s.imbalance_at_first_break = 1e-6;
    s.trusted = false;
    s.seconds = {{"setup", 1}, {"solve", 2}, {"draw", 3}, {"encode", 4}, {"total", 10}};
    s.stopped = "velocity is no longer finite";
    s.warnings = {"one", "two"};
    return s;
}

TEST(Summary, ComesBack) {
    const TemporaryFolder folder;
    const RunSummary expected = full_summary();
    write_summary(folder.path(), expected);
    const RunSummary s = read_summary(folder.path());
    EXPECT_EQ(s.title, expected.title);
    EXPECT_EQ(s.scene_hash, expected.scene_hash);
    EXPECT_EQ(s.scene_file, expected.scene_file);
    EXPECT_EQ(s.version, expected.version);
    EXPECT_EQ(s.particles, expected.particles);
    EXPECT_EQ(s.bonds, expected.bonds);
    EXPECT_EQ(s.broken, expected.broken);
    EXPECT_EQ(s.frames, expected.frames);
    EXPECT_EQ(s.threads, expected.threads);
    EXPECT_EQ(s.dimension, expected.dimension);
    EXPECT_EQ(s.steps, expected.steps);
    EXPECT_EQ(s.time_step, expected.time_step);
    EXPECT_EQ(s.end_time, expected.end_time);
    ASSERT_TRUE(s.events.first_break);
    EXPECT_EQ(s.events.first_break->time, 1);
    EXPECT_EQ(s.events.first_break->load, 2);
    EXPECT_EQ(s.events.first_break->displacement, 3);
    EXPECT_EQ(s.events.first_break->position, Vec3(4, 5, 6));
    EXPECT_FALSE(s.events.peak_load);
    EXPECT_FALSE(s.events.separation);
    EXPECT_EQ(s.events.end, expected.events.end);
    EXPECT_EQ(s.crack.length, expected.crack.length);
    EXPECT_EQ(s.crack.tip, expected.crack.tip);
    EXPECT_EQ(s.crack.speed, expected.crack.speed);
    EXPECT_EQ(s.top_crack_speed, expected.top_crack_speed);
    EXPECT_EQ(s.fragments.count, expected.fragments.count);
    EXPECT_EQ(s.fragments.largest, expected.fragments.largest);
    EXPECT_EQ(s.fragments.debris, expected.fragments.debris);
    EXPECT_EQ(s.worst_imbalance, expected.worst_imbalance);
    EXPECT_EQ(s.imbalance_at_first_break, expected.imbalance_at_first_break);
    EXPECT_EQ(s.trusted, expected.trusted);
    EXPECT_EQ(s.seconds, expected.seconds);
    EXPECT_EQ(s.stopped, expected.stopped);
    EXPECT_EQ(s.warnings, expected.warnings);
}

TEST(Summary, HasEveryKeyScriptsRelyOnAndNullForWhatDidNotHappen) {
    const TemporaryFolder folder;
    write_summary(folder.path(), {});
    const json file = json::parse(read_file(folder.path() / "run.json"));
    for (const char* key : {"/scene/title",
                            "/scene/hash",
                            "/version",
                            "/counts/particles",
                            "/counts/bonds",
                            "/counts/broken",
                            "/counts/steps",
                            "/counts/frames",
                            "/time_step",
                            "/cracks/length",
                            "/cracks/speed",
                            "/cracks/top_speed",
                            "/fragments/count",
                            "/fragments/largest_mass",
                            "/fragments/debris_mass",
                            "/energy/worst_imbalance",
                            "/energy/trusted",
                            "/seconds/setup",
                            "/seconds/solve",
                            "/seconds/draw",
                            "/seconds/encode",
                            "/seconds/total"}) {
        ASSERT_TRUE(file.contains(json::json_pointer(key))) << key;
        EXPECT_FALSE(file[json::json_pointer(key)].is_null()) << key;
    }
    for (const char* key :
         {"/events/first_break", "/events/peak_load", "/events/separation", "/cracks/tip"}) {
        ASSERT_TRUE(file.contains(json::json_pointer(key))) << key;
        EXPECT_TRUE(file[json::json_pointer(key)].is_null()) << key;
    }
}

TEST(Summary, PositionHasTwoComponentsInTwoDimensions) {
    const TemporaryFolder folder;
    RunSummary s = full_summary();
    s.dimension = 2;
    write_summary(folder.path(), s);
    const json file = json::parse(read_file(folder.path() / "run.json"));
    EXPECT_EQ(file["events"]["first_break"]["position"], json::array({4.0, 5.0}));
}

TEST(Summary, ImbalanceThatIsNotFiniteCanBeReadAgain) {
    const TemporaryFolder folder;
    RunSummary s;
    s.worst_imbalance = std::numeric_limits<double>::infinity();
    write_summary(folder.path(), s);
    EXPECT_TRUE(std::isnan(read_summary(folder.path()).worst_imbalance));
}

TEST(Summary, DamageIsNamed) {
    const TemporaryFolder folder;
    write_file(folder.path() / "run.json", "{\"scene\": ");
    EXPECT_NE(message_of([&] { read_summary(folder.path()); }).find("run.json: not the summary of a run: "),
              std::string::npos);
    write_file(folder.path() / "run.json", "{}");
    EXPECT_NE(message_of([&] { read_summary(folder.path()); }).find("scene"), std::string::npos);
}

TEST(Frames, AreListedWithNullWhereNothingHappens) {
    const TemporaryFolder folder;
    write_frames(folder.path(), {{.file = "frames/000000.png", .time = 0, .sha256 = "ab"},
                                 {"frames/000001.png", 0.1, "first_break", {"first_break", "end"}, 3, "cd"}});
    const json expected = {{{"file", "frames/000000.png"},
                            {"time", 0.0},
                            {"event", nullptr},
                            {"events", json::array()},
                            {"broken", 0},
                            {"sha256", "ab"}},
                           {{"file", "frames/000001.png"},
                            {"time", 0.1},
                            {"event", "first_break"},
                            {"events", {"first_break", "end"}},
                            {"broken", 3},
                            {"sha256", "cd"}}};
    EXPECT_EQ(json::parse(read_file(folder.path() / "frames.json")), expected);
}

TEST(Summary, ProfileIsThereWhereOneWasMadeAndComesBack) {
    const TemporaryFolder folder;
    RunSummary s = full_summary();
    write_summary(folder.path(), s);
    EXPECT_FALSE(json::parse(read_file(folder.path() / "run.json")).contains("profile"));
    s.profile["draw"] = {{"read back", 0.25, 3}, {"overlay", 0.5, 4}};
    write_summary(folder.path(), s);
    const json profile = json::parse(read_file(folder.path() / "run.json")).at("profile");
    EXPECT_EQ(profile.at("draw")[0].at("stage"), "read back");
    const RunSummary back = read_summary(folder.path());
    ASSERT_EQ(back.profile.at("draw").size(), 2u);
    EXPECT_EQ(back.profile.at("draw")[1].name, "overlay");
    EXPECT_EQ(back.profile.at("draw")[1].seconds, 0.5);
    EXPECT_EQ(back.profile.at("draw")[1].calls, 4);
}

}  // namespace
}  // namespace hibi
