#include "picture_tests/reference.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "image/png.hpp"
#include "picture_tests/diff.hpp"
#include "picture_tests/junit.hpp"
#include "record/files.hpp"
#include "scene/keys.hpp"
#include "support/recorded_cantilever.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;

Reference reference() {
    Reference r;
    r.key = {"llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6", "x86-64-v3"};
    r.version = "0.1.0";
    r.scene_hash = "0123";
    r.frames = {{"first_break", "first_break.png", 0.5, "abcd", 500, 0.125},
                {"end", "first_break.png", 0.5, "abcd", 500, 0.125}};
    r.particles = 4, r.bonds = 6, r.broken = 2;
    r.spacing = 1, r.time_step = 1e-3, r.end_time = 0.7;
    r.events.first_break = Event{.time = 0.5, .load = 1e6};
    r.events.peak_load = Event{.time = 0.6, .load = 2e6};
    r.breaks = {{0, 1, 500}, {1, 2, 600}};
    return r;
}

TEST(Reference, IsReadAsItWasWritten) {
    const TemporaryFolder folder;
    EXPECT_FALSE(read_reference(folder.path()));
    Reference written = reference();
    written.events.separation = Event{.time = 0.65, .load = 3};
    write_reference(folder.path(), written);
    const std::optional<Reference> read = read_reference(folder.path());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->key, written.key);
    EXPECT_EQ(read->breaks, written.breaks);
    EXPECT_EQ(read->frames[1].moment, "end");
    EXPECT_EQ(read->frames[1].displacement, 0.125);
    ASSERT_TRUE(read->events.separation);
    EXPECT_EQ(read->events.separation->time, 0.65);
    EXPECT_EQ(read->events.separation->load, 3);
    EXPECT_EQ(physics_change(written, *read, {.position = 0, .break_steps = 0, .load = 0}), "");

    std::string text = read_file(folder.path() / "references.json");
    text.replace(text.find("first_break.png"), 15, "../../other.png");
    write_file(folder.path() / "references.json", text);
    EXPECT_THROW(read_reference(folder.path()), std::invalid_argument);
}

TEST(Reference, SaysWhatChangedFirst) {
    Reference changed = reference();
    changed.breaks[1].step = 597;
    changed.events.peak_load->load *= 1.018;
    EXPECT_EQ(physics_change(reference(), changed, {}),
              "physics changed first at t = 597.0 ms: bond 1-2 broke 3 steps earlier; peak load +1.8 %");
    EXPECT_EQ(physics_change(reference(), changed, {.break_steps = 3, .load = 0.02}), "");

    changed = reference();
    changed.breaks.erase(changed.breaks.begin());
    changed.broken = 1;
    EXPECT_EQ(physics_change(reference(), changed, {}),
              "physics changed first at t = 500.0 ms: bond 0-1 did not break");

    changed = reference();
    changed.frames[0].displacement = 0.15;
    EXPECT_EQ(physics_change(reference(), changed, {}),
              "physics changed first at t = 500.0 ms: particles moved by 150.0 mm on average, not 125.0 mm");
    EXPECT_EQ(physics_change(reference(), changed, {.position = 0.03}), "");

    changed = reference();
    changed.particles = 5;
    EXPECT_EQ(physics_change(reference(), changed, {}).find("another body"), 0u);
    changed = reference();
    changed.time_step *= 1.1;
    EXPECT_EQ(physics_change(reference(), changed, {}).find("another time step"), 0u);
    changed = reference();
    changed.end_time += 0.01;
    EXPECT_NE(physics_change(reference(), changed, {}).find("it ends at 710.0 ms, not at 700.0 ms"),
              std::string::npos);
    changed = reference();
    changed.bonds = 7;
    EXPECT_EQ(physics_change(reference(), changed, {}), "another body: 4 particles and 7 bonds, not 4 and 6");
    changed = reference();
    changed.broken = 3;  // one that the list of the first does not name
    EXPECT_EQ(physics_change(reference(), changed, {}),
              "physics changed first at t = 700.0 ms: 3 broken bonds, not 2");
}

TEST(Reference, OfSeveralBreaksTheEarliestIsNamed) {
    Reference a = reference(), b = a;
    a.breaks = {{1, 2, 500}, {0, 1, 600}};
    b.breaks = {{1, 2, 510}, {0, 1, 610}};
    EXPECT_EQ(physics_change(a, b, {}),
              "physics changed first at t = 500.0 ms: bond 1-2 broke 10 steps later");
}

TEST(Reference, LoadsCountByThemselvesWhateverTheirSign) {
    Reference pushed = reference();
    pushed.events.first_break->load *= -1;
    pushed.events.peak_load->load *= -1;
    Reference changed = pushed;
    changed.events.first_break->load *= 1.01;
    EXPECT_EQ(physics_change(pushed, changed, {}), "physics changed: load at first break +1.0 %");
    EXPECT_EQ(physics_change(pushed, changed, {.load = 0.006}), "");  // of the peak, twice as large
    changed = pushed;
    changed.events.peak_load->load *= 0.99;
    EXPECT_EQ(physics_change(pushed, changed, {}), "physics changed: peak load -1.0 %");
    changed.events.peak_load = {};
    EXPECT_EQ(physics_change(pushed, changed, {}), "physics changed: peak load none, expected one");
}

// Where another step was recorded last, the particles have moved on, which is no change.
TEST(Reference, DisplacementsAreComparedAtTheSameStep) {
    Reference changed = reference();
    for (ReferenceFrame& frame : changed.frames) frame.step = 501, frame.displacement = 0.2;
    EXPECT_EQ(physics_change(reference(), changed, {}), "");
    for (ReferenceFrame& frame : changed.frames) frame.step = 500;
    EXPECT_NE(physics_change(reference(), changed, {}), "");
}

// Of more breaks than are kept, those beyond the end of either list say nothing.
TEST(Reference, AListThatWasCutDoesNotInventChanges) {
    Reference a = reference(), b = reference();
    a.breaks.clear();
    for (int k = 0; k < static_cast<int>(Reference::most_breaks); ++k) a.breaks.push_back({k, k + 1, 10 * k});
    b.breaks = a.breaks;
    b.breaks.pop_back();
    b.breaks.insert(b.breaks.begin(), {900, 901, 5});
    EXPECT_EQ(physics_change(a, b, {}),
              "physics changed first at t = 5.000 ms: bond 900-901 broke, which it did not");
    b.breaks = a.breaks;
    b.breaks.back() = {700, 701, 1990};  // at the last moment of the list others may have been cut off
    EXPECT_EQ(physics_change(a, b, {}), "");
}

TEST(Reference, MomentsAtOneTimeShareAPictureAndWhatDidNotHappenIsLeftOut) {
    const TemporaryFolder folder;
    const RecordedCantilever cantilever;
    cantilever.write(folder.path());
    Scene scene = cantilever.scene();
    scene.test.width = 128;
    scene.test.height = 96;
    scene.test.frames = {
        {EventName::separation, 0}, {EventName::separation, 9}, {{}, 1.5}, {EventName::start, 0.25}};
    const DrawnTest test = draw_test(scene, RunReader(folder.path()), {});
    ASSERT_EQ(test.reference.frames.size(), 3u);
    EXPECT_EQ(test.reference.frames[0].moment, "start+0.25s");
    EXPECT_EQ(test.reference.frames[1].moment, "separation");
    EXPECT_EQ(test.reference.frames[2].moment, "at_1.5s");
    EXPECT_EQ(test.reference.frames[2].file, "separation.png");
    const Image& image = test.image_of("separation.png");
    EXPECT_EQ(image.width, 128);
    EXPECT_EQ(image.height, 96);
    EXPECT_EQ(test.reference.frames[1].sha256, pixel_hash(image));
    // The numbers are those of the last state by then, one every 0.05 s.
    const RunReader run(folder.path());
    for (const ReferenceFrame& frame : test.reference.frames) {
        const auto state = std::ranges::find(run.states(), frame.step, &StateInfo::step);
        ASSERT_NE(state, run.states().end());
        EXPECT_LE(state->time, frame.time);
        EXPECT_GT(state->time, frame.time - 0.06) << frame.moment;
        double squares = 0;
        const std::vector<Vec3> moved = run.read(static_cast<int>(state - run.states().begin())).displacement;
        for (const Vec3& u : moved) squares += u.squaredNorm();
        EXPECT_NEAR(frame.displacement, std::sqrt(squares / static_cast<double>(moved.size())), 1e-12);
    }
    EXPECT_EQ(test.reference.key.renderer.find("OSMesa"), std::string::npos);
    EXPECT_NE(test.reference.key.renderer.find("Mesa "), std::string::npos);
}

// The table of keys and the structs both name the defaults.
TEST(Limits, OfAnEmptyTableAreTheUsualOnesAndEachCanBeSet) {
    const KeyBlock& keys = scene_block("tolerance");
    TestLimits usual, other;
    TestLimits::each(usual, [&]<class T>(const char* key, std::optional<T>& limit) {
        ASSERT_TRUE(keys.find(key)) << key;
        limit = static_cast<T>(std::stod(keys.find(key)->standard));
    });
    EXPECT_EQ(keys.keys.size(), 7u);
    Tolerance pixels{.tile = -1, .pixels = -1, .mean = -1, .rmse = -1};
    RunTolerance run{.position = -1, .break_steps = -1, .load = -1};
    set_limits(usual, pixels, run);
    const Tolerance standard;
    const RunTolerance standard_run;
    EXPECT_EQ(std::tuple(pixels.tile, pixels.pixels, pixels.mean, pixels.rmse),
              std::tuple(standard.tile, standard.pixels, standard.mean, standard.rmse));
    EXPECT_EQ(std::tuple(run.position, run.break_steps, run.load),
              std::tuple(standard_run.position, standard_run.break_steps, standard_run.load));
    other.mean = 5;
    set_limits(other, pixels, run);
    EXPECT_EQ(pixels.mean, 5);
    EXPECT_EQ(pixels.tile, standard.tile);
}

TEST(Junit, CountsAndEscapes) {
    const std::string xml = junit_xml("s", {{"a", "fine", 0.5, "", ""},
                                            {"a", "off", 0, "2 < 3 & \"so\"\non", ""},
                                            {"b", "broken", 0, "", "no file\x01"}});
    EXPECT_NE(xml.find("tests=\"3\" failures=\"1\" errors=\"1\" time=\"0.500\""), std::string::npos) << xml;
    EXPECT_NE(xml.find("<failure message=\"2 &lt; 3 &amp; &quot;so&quot; on\"/>"), std::string::npos) << xml;
    EXPECT_NE(xml.find("<error message=\"no file\"/>"), std::string::npos) << xml;
}

}  // namespace
}  // namespace hibi
