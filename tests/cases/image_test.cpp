// hibi test as a user calls it, on a plate of 50 particles that breaks within a second of computing.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "image/png.hpp"
#include "record/files.hpp"
#include "scene/everything.hpp"
#include "support/call.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class ImageTest : public testing::Test {
 protected:
    ImageTest() {
        std::string text = small_scene;
        text.replace(text.find("separation + 0.5 s"), 18, "first_break + 1 s");
        write(text + "[test]\nframes = [\"first_break\", \"end\"]\n");
    }
    void write(const std::string& text) {
        text_ = text;
        std::ofstream(at("plate.toml")) << text;
    }
    void edit(const std::string& from, const std::string& to) {
        std::string text = text_;
        ASSERT_NE(text.find(from), std::string::npos) << from;
        write(text.replace(text.find(from), from.size(), to));
    }
    Answer test(const std::string& arguments, const std::string& environment = "CI=") const {
        return call("cd " + folder_.path().string() + " && " + environment +
                    " " HIBI_PROGRAM " test -q plate.toml " + arguments);
    }
    fs::path at(const std::string& name) const { return folder_.path() / name; }
    fs::path reference(const std::string& name) const { return at("references/plate") / name; }

    TemporaryFolder folder_;
    std::string text_;
};

bool has(const Answer& answer, const std::string& words) {
    return answer.out.find(words) != std::string::npos;
}

TEST_F(ImageTest, WithoutReferencesFailsAndSaysHowToGetThemThenPasses) {
    Answer answer = test("");
    EXPECT_EQ(answer.status, 3) << answer.out;
    EXPECT_TRUE(has(answer, "FAIL plate")) << answer.out;
    EXPECT_TRUE(
        has(answer, "has no references; look at the pictures that hibi test --update missing plate.toml"))
        << answer.out;
    answer = test("--update missing", "CI=true");
    EXPECT_EQ(answer.status, 2);
    EXPECT_TRUE(has(answer, "CI=true")) << answer.out;
    EXPECT_FALSE(fs::exists(reference("references.json")));

    answer = test("--update missing");
    EXPECT_EQ(answer.status, 0) << answer.out;
    EXPECT_TRUE(has(answer, "new references/plate/first_break.png")) << answer.out;
    const Image picture = read_png(reference("first_break.png"));
    EXPECT_EQ(picture.width, 320);
    EXPECT_EQ(picture.height, 180);
    EXPECT_FALSE(fs::exists(reference("start.png")));  // not asked for

    answer = test("--json --junit junit.xml", "CI=true");
    EXPECT_EQ(answer.status, 0) << answer.out;
    const Json scene = Json::parse(answer.out)[0];
    EXPECT_EQ(scene["verdict"], "same");
    EXPECT_EQ(scene["exact"], true);
    EXPECT_EQ(scene["frames"].size(), 2u);
    EXPECT_EQ(scene["frames"][0]["sameness"], "identical");
    EXPECT_NE(read_file(at("junit.xml")).find("tests=\"3\" failures=\"0\" errors=\"0\""), std::string::npos);
    EXPECT_FALSE(fs::exists(at("out/test/plate")));  // what passed leaves nothing behind

    // The other library gives the same pixels, and other processors nearly so.
    EXPECT_EQ(test("--gl egl").status, 0);
    answer = test("", "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1");
    EXPECT_EQ(answer.status, 0) << answer.out;
    EXPECT_TRUE(has(answer, "tolerant, since the references are from another renderer or processor"))
        << answer.out;
}

TEST_F(ImageTest, TellsChangedDrawingFromChangedPhysicsAndKeepsTheOldPicture) {
    ASSERT_EQ(test("--update all").status, 0);
    edit("\"small\"", "\"smell\"");
    Answer answer = test("--junit junit.xml");
    EXPECT_EQ(answer.status, 3);
    EXPECT_TRUE(has(answer, "drawing changed, physics the same (exact)")) << answer.out;
    EXPECT_TRUE(has(answer, "out/test/plate/end/difference.html")) << answer.out;
    EXPECT_TRUE(fs::exists(at("out/test/plate/end/heat.png")));
    EXPECT_TRUE(fs::exists(at("out/test/plate/run/states")));
    EXPECT_NE(read_file(at("junit.xml")).find("failures=\"2\""), std::string::npos);

    const std::string old = pixel_hash(read_png(reference("end.png")));
    answer = test("--update missing");  // none is
    EXPECT_EQ(answer.status, 3) << answer.out;
    EXPECT_EQ(pixel_hash(read_png(reference("end.png"))), old);
    answer = test("--update changed");
    EXPECT_EQ(answer.status, 0) << answer.out;
    EXPECT_TRUE(has(answer, "changed references/plate/end.png")) << answer.out;
    EXPECT_EQ(pixel_hash(read_png(reference("end.old.png"))), old);
    EXPECT_NE(pixel_hash(read_png(reference("end.png"))), old);
    EXPECT_EQ(test("").status, 0);
    EXPECT_FALSE(fs::exists(at("out/test/plate")));

    // What passes is not renewed.
    answer = test("--update changed");
    EXPECT_EQ(answer.status, 0);
    EXPECT_TRUE(has(answer, "ok   plate")) << answer.out;
    EXPECT_FALSE(has(answer, "updated")) << answer.out;

    edit("break_strain = 0.1", "break_strain = 0.099");
    answer = test("--junit junit.xml");
    EXPECT_EQ(answer.status, 3);
    EXPECT_NE(read_file(at("junit.xml")).find("name=\"physics\" time="), std::string::npos);
    EXPECT_NE(read_file(at("junit.xml")).find("<failure message=\"physics changed first"), std::string::npos);
    EXPECT_TRUE(has(answer, "physics changed first at t = ")) << answer.out;
    EXPECT_TRUE(has(answer, " earlier; load at first break -0.85 %")) << answer.out;
    edit("spacing = \"4 m\"", "spacing = \"5 m\"");
    EXPECT_TRUE(has(test(""), "another body: 32 particles")) << answer.out;
}

TEST_F(ImageTest, ParametersOfTheTestMakeItCoarser) {
    write(text_ + "params = [\"spacing=5 m\"]\n");
    ASSERT_EQ(test("--update all").status, 0);
    EXPECT_EQ(Json::parse(read_file(reference("references.json")))["physics"]["particles"], 32);
    EXPECT_EQ(test("").status, 0);
    edit("spacing=5 m", "spaking=5 m");
    const Answer answer = test("");
    EXPECT_EQ(answer.status, 2);
    EXPECT_TRUE(has(answer, "no parameter \"spaking\"")) << answer.out;
}

TEST_F(ImageTest, DamagedReferencesNeverPass) {
    ASSERT_EQ(test("--update all").status, 0);
    const fs::path picture = reference("end.png");
    const std::string whole = read_file(picture);
    fs::resize_file(picture, whole.size() / 2);
    Answer answer = test("");
    EXPECT_NE(answer.status, 0);
    EXPECT_TRUE(has(answer, "end.png: damaged PNG picture")) << answer.out;
    fs::remove(picture);
    answer = test("");
    EXPECT_EQ(answer.status, 3);
    EXPECT_TRUE(has(answer, "end: has no reference: references/plate/end.png is missing")) << answer.out;
    EXPECT_EQ(test("--update missing").status, 0);
    EXPECT_EQ(read_file(picture), whole);
    write_png(picture, Image(100, 100));
    EXPECT_TRUE(has(test(""), "end.png is not the picture that references.json names"));
    std::ofstream(picture, std::ios::binary) << whole;
    EXPECT_EQ(test("").status, 0);

    const std::string json = read_file(reference("references.json"));
    std::ofstream(reference("references.json")) << json.substr(0, json.size() / 2);
    answer = test("");
    EXPECT_EQ(answer.status, 2);
    EXPECT_TRUE(has(answer, "references.json: not the references of a test")) << answer.out;
}

TEST_F(ImageTest, OnlyWhatIsMissingIsAddedAndTheRestIsStillJudged) {
    ASSERT_EQ(test("--update all").status, 0);
    const std::string old = pixel_hash(read_png(reference("end.png")));
    edit("\"small\"", "\"smell\"");
    fs::remove(reference("first_break.png"));
    Answer answer = test("--update missing");
    EXPECT_EQ(answer.status, 3) << answer.out;
    EXPECT_TRUE(has(answer, "new references/plate/first_break.png")) << answer.out;
    EXPECT_TRUE(has(answer, "end: ")) << answer.out;
    EXPECT_FALSE(has(answer, "has no reference")) << answer.out;
    EXPECT_EQ(pixel_hash(read_png(reference("end.png"))), old);
    EXPECT_FALSE(fs::exists(reference("end.old.png")));
    answer = test("");
    EXPECT_EQ(answer.status, 3);
    EXPECT_FALSE(has(answer, "first_break: ")) << answer.out;
}

TEST_F(ImageTest, MomentsThatCameOrWentAreTold) {
    ASSERT_EQ(test("--update all").status, 0);
    edit("frames = [\"first_break\", \"end\"]", "frames = [\"start\", \"end\"]");
    Answer answer = test("");
    EXPECT_EQ(answer.status, 3);
    EXPECT_TRUE(has(answer, "start: has no reference")) << answer.out;
    EXPECT_TRUE(has(answer, "first_break: has a reference, but did not happen or is not in [test] frames"))
        << answer.out;
    fs::create_directories(at("out/test/plate"));
    std::ofstream(at("out/test/plate/notes.txt")) << "of somebody";
    answer = test("--update changed");
    EXPECT_EQ(answer.status, 0) << answer.out;
    EXPECT_TRUE(has(answer, "no longer used references/plate/first_break.png")) << answer.out;
    EXPECT_TRUE(fs::exists(reference("start.png")));
    EXPECT_TRUE(fs::exists(reference("first_break.old.png")));
    EXPECT_TRUE(fs::exists(at("out/test/plate/notes.txt")));
    EXPECT_EQ(test("").status, 0);

    edit("[test]\n", "[test]\nsize = [160, 90]\n");
    answer = test("");
    EXPECT_EQ(answer.status, 3);
    EXPECT_TRUE(has(answer, "end: one picture has 320 x 180 pixels, the other 160 x 90")) << answer.out;
}

// A pixel off by one is what another processor rounds; on the renderer of the references it is a change.
TEST_F(ImageTest, IsExactOnTheRendererOfTheReferencesAndTolerantElsewhere) {
    ASSERT_EQ(test("--update all").status, 0);
    Image picture = read_png(reference("end.png"));
    const std::string old = pixel_hash(picture);
    picture.pixel(100, 100)[1] ^= 1;
    write_png(reference("end.png"), picture);
    std::string list = read_file(reference("references.json"));
    ASSERT_NE(list.find(old), std::string::npos);
    list.replace(list.find(old), old.size(), pixel_hash(picture));
    write_file(reference("references.json"), list);
    Answer answer = test("");
    EXPECT_EQ(answer.status, 3);
    EXPECT_TRUE(has(answer, "end: not identical (worst tile ")) << answer.out;
    answer = test("--json", "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1");
    EXPECT_EQ(answer.status, 0) << answer.out;
    EXPECT_EQ(Json::parse(answer.out)[0]["frames"][1]["sameness"], "within tolerance");
}

TEST_F(ImageTest, ASceneHasLimitsOfItsOwnAndTheCommandGoesBeforeThem) {
    ASSERT_EQ(test("--update all").status, 0);
    edit("\"small\"", "\"smell\"");
    write(text_ + "tolerance = { tile = 99, pixels = 1e6, mean = 99, rmse = 99 }\n");
    const std::string elsewhere = "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1";
    Answer answer = test("", elsewhere);
    EXPECT_EQ(answer.status, 0) << answer.out;
    answer = test("--tile 0.5", elsewhere);
    EXPECT_EQ(answer.status, 3) << answer.out;
    EXPECT_TRUE(has(answer, ", limit 0.5, at (")) << answer.out;
    EXPECT_FALSE(has(answer, "pixels far off")) << answer.out;
    EXPECT_EQ(test("").status, 3);  // where the references are from, they are exact

    edit("break_strain = 0.1", "break_strain = 0.0999");
    EXPECT_TRUE(has(test("", elsewhere), "physics changed")) << answer.out;
    edit("tolerance = { ", "tolerance = { break_steps = 1000, position = 9, load = 0.1, ");
    EXPECT_FALSE(has(test("", elsewhere), "earlier")) << answer.out;
}

TEST_F(ImageTest, ScenesOfOneNameInSeveralFoldersAreAllTested) {
    fs::create_directories(at("others"));
    std::string short_run = text_;
    short_run.replace(short_run.find("first_break + 1 s"), 17, "first_break + 0 s");
    for (const char* name : {"plate.toml", "wall.toml", "beam.toml"})
        std::ofstream(at("others") / name) << short_run;
    ASSERT_EQ(test("others --update all").status, 0);
    std::ofstream(at("others/wall.toml")) << short_run.replace(short_run.find("small"), 5, "smell");
    const Answer answer = test("others");
    EXPECT_EQ(answer.status, 3);
    std::size_t place = 0;
    for (const char* line :
         {"ok   plate ", "ok   beam ", "ok   plate_2 ", "FAIL wall ", "3 of 4 scenes pass"}) {
        EXPECT_NE(place = answer.out.find(line, place), std::string::npos) << line << answer.out;
        if (place == std::string::npos) break;
    }
    EXPECT_TRUE(fs::exists(at("out/test/wall/end/difference.html")));
    fs::create_directories(at("empty"));
    EXPECT_TRUE(has(test("empty"), "empty: holds no scene"));
}

TEST_F(ImageTest, ARunThatFailsIsNoDifference) {
    ASSERT_EQ(test("--update all").status, 0);
    edit("max_time = \"60 s\"", "max_time = \"60 s\"\ntime_step = \"1 s\"");
    Answer answer = test("");
    EXPECT_EQ(answer.status, 2);  // not a stable time step: the scene is wrong
    EXPECT_TRUE(has(answer, "plate.toml:")) << answer.out;

    // No file may grow beyond a few kilobytes: the run ends, and is not taken for one that differs.
    edit("\ntime_step = \"1 s\"", "");
    answer = test("--json", "ulimit -f 8 &&");
    EXPECT_EQ(answer.status, 1) << answer.out;
    EXPECT_TRUE(has(answer, "\"pass\": false")) << answer.out;
}

/// The lines of `text` that begin with `start`, without it.
std::vector<std::string> lines_after(const std::string& text, const std::string& start) {
    std::vector<std::string> lines;
    for (std::size_t at = 0; (at = text.find("\n" + start, at)) != std::string::npos; ++at) {
        const std::size_t begin = at + 1 + start.size();
        lines.push_back(text.substr(begin, text.find('\n', begin) - begin));
    }
    return lines;
}

TEST(TestingPage, ItsWorkflowIsTheOneBesideTheExampleAndRuns) {
    const fs::path ci = HIBI_SOURCE_DIR "/scenes/ci";
    const std::string workflow = read_file(ci / "workflow.yml");
    std::string indented = workflow;
    for (std::size_t at = 0; (at = indented.find('\n', at)) + 1 < indented.size(); at += 4)
        indented.replace(at, 1, "\n   ");
    EXPECT_NE(read_file(HIBI_SOURCE_DIR "/scenes/TESTING.md").find("```yaml\n   " + indented),
              std::string::npos);

    const TemporaryFolder folder;
    fs::copy(ci, folder.path(), fs::copy_options::recursive);
    int ran = 0;
    for (const std::string& command : lines_after(workflow, "      - run: ")) {
        if (!command.starts_with("hibi ")) continue;  // installing
        const Answer answer =
            call("cd " + folder.path().string() + " && CI=true PATH=" HIBI_BUILD_DIR ":$PATH " + command);
        EXPECT_EQ(answer.status, 0) << command << answer.out;
        ++ran;
    }
    EXPECT_EQ(ran, 1);
    EXPECT_TRUE(fs::exists(folder.path() / "out/test/junit.xml"));
}

/// A page of a failure, which Chromium opens.
TEST(WebDifference, PageSlidesFlickersAndAsksNothingOfANetwork) {
    const TemporaryFolder folder;
    Image a(320, 180), b(320, 180);
    for (int k = 0; k < 320 * 180; ++k) {
        a.bgra[4 * k] = b.bgra[4 * k] = static_cast<std::uint8_t>(k % 251);
        a.bgra[4 * k + 1] = b.bgra[4 * k + 1] = static_cast<std::uint8_t>(k / 320);
    }
    for (int y = 90; y < 100; ++y)
        for (int x = 200; x < 215; ++x) b.pixel(x, y)[2] = 255;
    write_png(folder.path() / "a.png", a);
    write_png(folder.path() / "b.png", b);
    const Answer answer = call("cd " + folder.path().string() +
                               " && " HIBI_PROGRAM " diff a.png b.png; node " HIBI_WEB
                               "/difference_check.mjs out/diff/difference.html");
    EXPECT_EQ(answer.status, 0) << answer.out;
}

}  // namespace
}  // namespace hibi
