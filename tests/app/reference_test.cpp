#include "app/reference.hpp"

#include <gtest/gtest.h>

#include "app/junit.hpp"
#include "app/recorded_cantilever.hpp"
#include "image/png.hpp"
#include "record/files.hpp"
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
    const Reference written = reference();
    write_reference(folder.path(), written);
    const std::optional<Reference> read = read_reference(folder.path());
    ASSERT_TRUE(read);
    EXPECT_EQ(read->key, written.key);
    EXPECT_EQ(read->breaks, written.breaks);
    EXPECT_EQ(read->frames[1].moment, "end");
    EXPECT_EQ(read->frames[1].displacement, 0.125);
    EXPECT_FALSE(read->events.separation);
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
    EXPECT_EQ(test.reference.key.renderer.find("OSMesa"), std::string::npos);
    EXPECT_NE(test.reference.key.renderer.find("Mesa "), std::string::npos);
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
