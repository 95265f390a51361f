// Static runs as a user calls them. What the solver itself does is in tests/statics.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>

#include "base/hash.hpp"
#include "record/run_folder.hpp"
#include "record/tables.hpp"
#include "support/call.hpp"
#include "support/films.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// The cantilever plate of scenes/bending_coarse.toml, 40 m x 20 m; its tip is pulled down by up to 80 MN.
std::string cantilever(const std::string& run, const std::string& spacing = "4 m",
                       const std::string& ramp = "40 s", const std::string& break_strain = "0.1") {
    return R"([material.concrete]
density = "2300 kg/m^3"
youngs_modulus = "210 MPa"
poissons_ratio = 0.3
break_strain = )" +
           break_strain + R"(
[[body]]
name = "plate"
material = "concrete"
box = [[0, 0], ["40 m", "20 m"]]
spacing = ")" +
           spacing + R"("
[[fix]]
where = "x < )" +
           spacing + R"("
hold = ["x", "y"]
[[load]]
name = "tip"
where = "x > 40 m - )" +
           spacing + R"("
force = [0, "-80 MN"]
ramp = ")" +
           ramp +
           R"("
[run]
)" + run;
}

/// Columns of 1 m particles on a clamped foot, pressed down by up to `force`, and a little to the side.
std::string column(int width, int height, const std::string& force, const std::string& run,
                   const std::string& ramp = "ramp = \"1 s\"\n") {
    return R"([material.concrete]
density = "2300 kg/m^3"
youngs_modulus = "210 MPa"
poissons_ratio = 0.3
break_strain = 0.5
[[body]]
name = "column"
material = "concrete"
spacing = "1 m"
box = [[0, 0], [)" +
           std::to_string(width) + ", " + std::to_string(height) + R"(]]
[[fix]]
where = "y < 1 m"
hold = ["x", "y"]
[[load]]
name = "top"
where = "y > )" +
           std::to_string(height - 1) + R"( m"
force = ["20 N", ")" +
           force + "\"]\n" + ramp + "[run]\nmax_time = \"1 s\"\n" + run;
}

const std::string statics = "method = \"static\"\n";

struct Outcome {
    Answer answer;
    fs::path folder;

    Json json() const { return Json::parse(std::ifstream(folder / "run.json")); }
    History history() const { return read_history(folder / "history.csv"); }
    double first_break_load() const { return json()["events"]["first_break"]["load"]; }
};

Outcome run(const TemporaryFolder& folder, const std::string& name, const std::string& scene,
            const std::string& options = "--no-pictures") {
    const fs::path file = folder.path() / (name + ".toml");
    std::ofstream(file) << scene << test::small_film;
    const fs::path out = folder.path() / name;
    return {
        call("timeout 200 " HIBI_PROGRAM " run " + file.string() + " -q " + options + " -o " + out.string()),
        out};
}

bool matches(const std::string& text, const std::string& pattern) {
    return std::regex_search(text, std::regex(pattern));
}

TEST(StaticRun, MakesStatesTablesFilmAndReportLikeAnyRun) {
    const TemporaryFolder folder;
    const Outcome r = run(folder, "bending", cantilever(statics + "max_time = \"40 s\"\n"), "");
    ASSERT_EQ(r.answer.status, 0) << r.answer.out;
    for (const char* file : {"movie.mp4", "poster.png", "strip.png", "curve.png", "cracks.png", "report.html",
                             "caption.md", "breaks.csv", "states.hdf.series"})
        EXPECT_TRUE(fs::exists(r.folder / file)) << file;
    EXPECT_EQ(read_frames(r.folder).size(), 5u);
    const Json json = r.json();
    EXPECT_TRUE(json["energy"]["trusted"]);
    EXPECT_LT(json["energy"]["worst_imbalance"].get<double>(), 1e-3);
    EXPECT_EQ(read_breaks(r.folder / "breaks.csv").size(), json["counts"]["broken"].get<std::size_t>());
    const RunReader states(r.folder);
    EXPECT_GT(states.states().size(), 20u);
    EXPECT_EQ(states.states().back().time, 40);
    const History history = r.history();
    EXPECT_GT(history.rows.size(), 50u);  // one per load step at least
    for (std::size_t k = 1; k < history.rows.size(); ++k)
        EXPECT_GT(history.rows[k].time, history.rows[k - 1].time);
    for (const HistoryRow& row : history.rows) EXPECT_EQ(row.kinetic, 0);
}

// Damped and slow, the explicit run breaks late by 0.3 / (pi N): below 0.3 % at the thirty first periods that
// this ramp takes.
TEST(StaticRun, FirstBreaksUnderTheLoadOfTheDampedExplicitRun) {
    const TemporaryFolder folder;
    const Outcome still =
        run(folder, "static",
            cantilever(statics + "max_time = \"80 s\"\nuntil = \"first_break\"\n", "4 m", "80 s"));
    const Outcome moving =
        run(folder, "explicit",
            "damping = \"quasi-static\"\n" +
                cantilever("max_time = \"80 s\"\nuntil = \"first_break\"\n", "4 m", "80 s"));
    ASSERT_EQ(still.answer.status, 0) << still.answer.out;
    ASSERT_EQ(moving.answer.status, 0) << moving.answer.out;
    EXPECT_NEAR(moving.first_break_load() / still.first_break_load(), 1, 0.01);
    EXPECT_NEAR(still.first_break_load() / 5.78e7, 1, 0.01);
    EXPECT_EQ(still.json()["events"]["first_break"]["position"],
              moving.json()["events"]["first_break"]["position"]);
}

TEST(StaticRun, BreaksBondByBondUntilSeparationAndLeavesTheFragmentWhereItWas) {
    const TemporaryFolder folder;
    const Outcome r = run(folder, "bending", cantilever(statics + "max_time = \"40 s\"\n", "2 m"));
    ASSERT_EQ(r.answer.status, 0) << r.answer.out;
    const Json json = r.json();
    ASSERT_FALSE(json["events"]["separation"].is_null()) << r.answer.out;
    EXPECT_EQ(json["fragments"]["count"], 2);
    std::vector<Break> breaks = read_breaks(r.folder / "breaks.csv");
    ASSERT_GT(breaks.size(), 5u);
    for (std::size_t k = 1; k < breaks.size(); ++k) EXPECT_GT(breaks[k].time, breaks[k - 1].time);

    // The load goes on rising for the rest of the run: the piece it hangs on, torn off, neither flies nor
    // makes the run fail.
    const double separation = json["events"]["separation"]["time"];
    ASSERT_LT(separation, 35);
    double place = 0, last = 0;
    for (const HistoryRow& row : r.history().rows) {
        if (row.time < separation) continue;
        if (place == 0) place = row.displacement;
        last = row.displacement;
    }
    EXPECT_NE(place, 0);
    EXPECT_EQ(last, place);
    EXPECT_FALSE(matches(r.answer.out, "no equilibrium")) << r.answer.out;
}

TEST(StaticRun, BreaksAllAtOnceWhereThatIsAskedFor) {
    const TemporaryFolder folder;
    const Outcome r =
        run(folder, "bending", cantilever(statics + "breaking = \"together\"\nmax_time = \"40 s\"\n"));
    ASSERT_EQ(r.answer.status, 0) << r.answer.out;
    std::map<double, int> at;
    for (const Break& b : read_breaks(r.folder / "breaks.csv")) ++at[b.time];
    EXPECT_TRUE(std::ranges::any_of(at, [](const auto& moment) { return moment.second > 1; }));
}

// 5000 particles, so that there is work for three threads.
TEST(StaticRun, SameBitsOnOneTwoAndThreeThreads) {
    const TemporaryFolder folder;
    const std::string scene =
        cantilever(statics + "load_steps = 2\nmax_time = \"40 s\"\nuntil = \"first_break + 5 ms\"\n", "0.4 m",
                   "40 s", "0.01");
    std::vector<std::string> hashes;
    for (const char* threads : {"1", "2", "3"}) {
        const Outcome r = run(folder, std::string("on") + threads, scene,
                              std::string("--no-pictures --threads ") + threads);
        ASSERT_EQ(r.answer.status, 0) << r.answer.out;
        std::string bits;
        const auto add = [&](const void* data, std::size_t size) { bits += sha256(data, size); };
        const RunReader states(r.folder);
        for (std::size_t k = 0; k < states.states().size(); ++k) {
            const Snapshot state = states.read(static_cast<int>(k));
            add(state.displacement.data(), state.displacement.size() * sizeof state.displacement[0]);
            add(state.stress.data(), state.stress.size() * sizeof state.stress[0]);
        }
        const auto breaks = read_breaks(r.folder / "breaks.csv");
        ASSERT_GT(breaks.size(), 1u);
        for (const Break& b : breaks) add(&b.time, sizeof b.time);
        for (const HistoryRow& row : r.history().rows) add(&row.elastic, sizeof row.elastic);
        hashes.push_back(bits);
    }
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
}

// Its Euler load is pi^2 E I / (4 L^2) = 0.22 MN.
TEST(StaticRun, AColumnThatBucklesBeforeItBreaksSaysWhereAndThatMoreLoadStepsMayHelp) {
    const TemporaryFolder folder;
    const Outcome r = run(folder, "column", column(2, 40, "-0.8 MN", statics + "load_steps = 2\n"));
    EXPECT_EQ(r.answer.status, 1) << r.answer.out;
    EXPECT_TRUE(matches(r.answer.out,
                        "column.toml: error: no equilibrium found between the loads at t = [0-9.]+ ms and "
                        "[0-9.]+ ms: body \"column\" gives way, most of all at \\([0-9.]+, [0-9.]+\\) m; it "
                        "buckles, or bears no more: try more load_steps or a smaller load; method = "
                        "\"explicit\" shows the motion\n"
                        "Everything recorded until then is in .*; draw it with: hibi render "))
        << r.answer.out;
    EXPECT_FALSE(r.json()["energy"]["trusted"]);
    EXPECT_TRUE(matches(r.json()["stopped"], "^no equilibrium found"));
    const Answer drawn = call(HIBI_PROGRAM " render -q " + r.folder.string());
    EXPECT_EQ(drawn.status, 0) << drawn.out;
    std::ifstream caption(r.folder / "caption.md");
    const std::string text(std::istreambuf_iterator<char>(caption), {});
    EXPECT_NE(text.find("The run stopped early"), std::string::npos) << text;
    // The way out that the message names.
    const Outcome finer = run(folder, "finer", column(2, 40, "-0.8 MN", statics + "load_steps = 100\n"));
    EXPECT_EQ(finer.answer.status, 0) << finer.answer.out;
    EXPECT_NEAR(finer.history().rows.back().displacement, 43.4, 0.5);  // it hangs down on one side
}

// What the README of the scenes says: it breaks where the same column does with a little to one side.
TEST(StaticRun, AStraightColumnThatBucklesIsWarnedOfInAllResults) {
    const TemporaryFolder folder;
    const auto straight = [](std::string scene, const std::string& aside) {
        scene.replace(scene.find("\"20 N\""), 6, "\"" + aside + "\"");
        return scene.replace(scene.find("break_strain = 0.5"), 18, "break_strain = 0.1");
    };
    const std::string scene = column(4, 40, "-10 MN", statics);
    const Outcome r = run(folder, "straight", straight(scene, "0 N"), "");
    const Outcome pushed = run(folder, "pushed", straight(scene, "1 kN"));
    ASSERT_EQ(r.answer.status, 0) << r.answer.out;
    const std::string words =
        "equilibrium became unstable at t = 18[0-9].[0-9] ms, under a load of 1.8[0-9]+ MN: "
        "body \"column\" buckles, most of all at \\(3.5, 39.5\\) m";
    EXPECT_TRUE(matches(r.answer.out, "straight.toml: warning: " + words)) << r.answer.out;
    EXPECT_TRUE(matches(r.json()["warnings"].dump(), "buckles, most of all at"));
    std::ifstream report(r.folder / "report.html");
    EXPECT_TRUE(
        matches(std::string(std::istreambuf_iterator<char>(report), {}), "equilibrium became unstable at"));
    EXPECT_TRUE(r.json()["energy"]["trusted"]);
    EXPECT_NEAR(r.first_break_load() / pushed.first_break_load(), 1, 1e-3);
    EXPECT_FALSE(matches(pushed.answer.out, "unstable")) << pushed.answer.out;
}

TEST(StaticRun, WhatHasNoEquilibriumFromTheFirstMomentOnSaysSo) {
    const TemporaryFolder folder;
    const std::string scene = column(2, 8, "-1 TN", statics, "");
    const Outcome r = run(folder, "column", scene);
    EXPECT_EQ(r.answer.status, 1) << r.answer.out;
    EXPECT_TRUE(matches(
        r.answer.out,
        "column.toml: error: no equilibrium under .* % of what acts from the first moment on "
        "\\(gravity, and loads without a ramp\\): body \"column\" is crushed, stretched or flung beyond "
        "what a linear law can stand for, most of all at .*; the loads may be far too large for the "
        "material: are their units and that of youngs_modulus right\\? If so, try a smaller load, or "
        "less gravity\n"))
        << r.answer.out;
    const Answer check = call(HIBI_PROGRAM " check " + (folder.path() / "column.toml").string());
    EXPECT_EQ(check.status, 0);
    EXPECT_TRUE(matches(check.out, "note +no equilibrium under ")) << check.out;
}

TEST(StaticRun, WhereNothingBreaksEverythingSaysSo) {
    const TemporaryFolder folder;
    const Outcome r =
        run(folder, "bending", cantilever(statics + "max_time = \"40 s\"\n", "4 m", "400 s"), "");
    ASSERT_EQ(r.answer.status, 0) << r.answer.out;
    EXPECT_TRUE(
        matches(r.answer.out, "first break      -\npeak load        t = 40.00 s .*\nseparation       -\n"))
        << r.answer.out;
    EXPECT_TRUE(
        matches(r.answer.out,
                "warning: nothing broke: in the end the most strained bond is at 1[0-9] % of its limit; "
                "raise the load, or max_time"))
        << r.answer.out;
    const auto holds = [&](const char* file, const char* words) {
        std::ifstream in(r.folder / file);
        const std::string text(std::istreambuf_iterator<char>(in), {});
        EXPECT_NE(text.find(words), std::string::npos) << file;
    };
    holds("report.html", "<p class=\"outcome\">No bond broke. Peak load at 40.0 s under 8.00 MN.</p>");
    holds("report.html", "Warning:</strong> nothing broke: in the end");
    holds("report.html", "<th scope=\"row\">First break</th><td colspan=\"4\">did not happen</td>");
    holds("report.html", "<th scope=\"row\">Separation</th><td colspan=\"4\">did not happen</td>");
    holds("caption.md", " No bond breaks. ");
}

TEST(StaticRun, WhatItDoesNotKnowIsRefusedWithItsPlace) {
    const TemporaryFolder folder;
    const std::string fine = cantilever(statics + "max_time = \"40 s\"\n");
    ASSERT_EQ(run(folder, "fine", fine).answer.status, 0);
    const auto expect = [&](const std::string& at, const std::string& to, const std::string& message) {
        std::string scene = fine;
        ASSERT_NE(scene.find(at), std::string::npos) << at;
        scene.replace(scene.find(at), at.size(), to);
        const Outcome r = run(folder, "wrong", scene);
        EXPECT_EQ(r.answer.status, 2) << r.answer.out;
        EXPECT_TRUE(matches(r.answer.out, "wrong.toml:[0-9]+:[0-9]+: error: " + message)) << r.answer.out;
        EXPECT_FALSE(fs::exists(r.folder));
    };
    const std::string no_motion = ": \\[run\\] method = \"static\" knows no motion";
    expect("name = \"plate\"", "name = \"plate\"\nvelocity = [1, 0]",
           "body \"plate\" has a velocity or spin" + no_motion);
    expect("name = \"plate\"", "name = \"plate\"\nspin = 1",
           "body \"plate\" has a velocity or spin" + no_motion);
    expect("force = [0, \"-80 MN\"]", "velocity = [\"free\", 1]", "\\[\\[load\\]\\] velocity" + no_motion);
    expect("[run]", "[damping]\nratio = 0.3\n[run]", "\\[damping\\]" + no_motion);
    expect("[run]", "[run]\ntime_step = \"1 ms\"", "\\[run\\] time_step" + no_motion);
    expect("[run]", "[run]\ntime_step_factor = 0.5", "\\[run\\] time_step_factor" + no_motion);
    expect("[run]", "[model]\nelasticity = \"thesis\"\n[run]",
           "\\[model\\] elasticity: method = \"static\" is for moment-matched alone");
    expect("hold = [\"x\", \"y\"]", "hold = [\"x\"]",
           "\\[run\\] method: the part of the model at .* can move freely, so it has no equilibrium");
}

}  // namespace
}  // namespace hibi
