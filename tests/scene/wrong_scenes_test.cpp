#include <gtest/gtest.h>
#include <unistd.h>

#include <ctime>
#include <filesystem>
#include <fstream>

#include "scene/everything.hpp"
#include "scene/read.hpp"

namespace hibi {
namespace {

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// What a wrong scene is answered; "" for a right one.
std::string answer(const std::string& text, const Overrides& overrides = {}) {
    try {
        parse_scene(text, "s.toml", overrides);
    } catch (const SceneErrors& errors) {
        return errors.what();
    }
    return "";
}

/// One thing wrong in the small scene: what is replaced by what, and the answer to be given.
struct Wrong {
    const char* name;
    const char* from;
    const char* to;
    const char* expected;
};

class WrongScene : public testing::TestWithParam<Wrong> {};

TEST_P(WrongScene, IsAnsweredWithPlaceExpectationAndWayOut) {
    const Wrong& wrong = GetParam();
    ASSERT_EQ(answer(small_scene), "");
    EXPECT_EQ(answer(replaced(small_scene, wrong.from, wrong.to)), wrong.expected);
}

INSTANTIATE_TEST_SUITE_P(
    All, WrongScene,
    testing::Values(
        Wrong{"Typo", "ramp =", "rmap =",
              "s.toml:23:1: error: unknown key \"rmap\" in [[load]]; did you mean \"ramp\"?\n"
              "   23 | rmap = \"40 s\"\n"
              "      | ^^^^"},
        Wrong{"TypoInABlock", "[run]", "[runn]",
              "s.toml:24:2: error: unknown block [runn]; did you mean \"run\"?\n"
              "   24 | [runn]\n"
              "      |  ^^^^\n"
              "s.toml:26:1: error: missing block [run]\n"
              "   26 | max_time = \"60 s\"\n"
              "      | ^ it needs at least max_time = \"10 s\""},
        Wrong{"WrongUnit", "\"-80 MN\"", "\"-2 MPa\"",
              "s.toml:22:17: error: [[load]] force needs a force (N); \"-2 MPa\" is a pressure\n"
              "   22 | force = [\"0 N\", \"-2 MPa\"]\n"
              "      |                 ^^^^^^^^ for a face load write: pressure = \"2 MPa\""},
        Wrong{"MissingMaterial", "material = \"concrete\"", "material = \"conkrete\"",
              "s.toml:12:12: error: [[body]] material: no material \"conkrete\"\n"
              "   12 | material = \"conkrete\"\n"
              "      |            ^^^^^^^^^^ did you mean \"concrete\"?"},
        Wrong{"NegativeDensity", "\"2300 kg/m^3\"", "\"-2300 kg/m^3\"",
              "s.toml:6:11: error: [material.concrete] density needs to be above 0; found -2300\n"
              "    6 | density = \"-2300 kg/m^3\"\n"
              "      |           ^^^^^^^^^^^^^^"},
        Wrong{"IncompressibleInPlaneStrain", "poissons_ratio = 0.3",
              "poissons_ratio = 0.5\n[model]\nassumption = \"plane "
              "strain\"\n[material.concrete.weibull]\nshape = 10",
              "s.toml:8:18: error: [material.concrete] poissons_ratio needs to be above -1 and below 0.5; "
              "found 0.5\n"
              "    8 | poissons_ratio = 0.5\n"
              "      |                  ^^^ nearly incompressible: 0.49\n"
              "s.toml:13:1: error: unknown key \"break_strain\" in [material.concrete] weibull\n"
              "   13 | break_strain = 0.1\n"
              "      | ^^^^^^^^^^^^ known: shape, seed"},
        Wrong{"InfluenceOnALatticeDistance", "[material", "[model]\ninfluence = 2.0\n[material",
              "s.toml:6:13: error: [model] influence: 2 is a distance of the lattice: rounding would decide "
              "who is a "
              "neighbour\n"
              "    6 | influence = 2.0\n"
              "      |             ^^^ for example 2.10"},
        Wrong{"InfluenceBelowTheDiagonal", "[material", "[model]\ninfluence = 1.3\n[material",
              "s.toml:6:13: error: [model] influence: 1.3 is below sqrt 2 = 1.414: without the diagonal "
              "bonds the "
              "lattice would shear freely\n"
              "    6 | influence = 1.3\n"
              "      |             ^^^ the default is 2.1"},
        Wrong{"EmptySelection", "x < spacing", "x < 1 m",
              "s.toml:17:9: error: [[fix]] where: selects no particle\n"
              "   17 | where = \"x < 1 m\"\n"
              "      |         ^^^^^^^^^ particle centres lie within x = 2 ... 38 m, y = 2 ... 18 m"},
        Wrong{"BodyOfNoParticle", "[[fix]]",
              "[[body]]\nmaterial = \"concrete\"\nspacing = \"1 m\"\n"
              "polygon = [[\"50 m\", \"0 m\"], [\"50.1 m\", \"0 m\"], [\"50 m\", \"0.1 m\"]]\n[[fix]]",
              "s.toml:15:1: error: [[body]]: body \"body2\" holds no particle\n"
              "   15 | [[body]]\n"
              "      | ^^^^^^^^ its shape is 0.1 m x 0.1 m, the spacing 1 m"},
        Wrong{"PolygonThatCrossesItself", "[[fix]]",
              "[[body]]\nmaterial = \"concrete\"\nspacing = \"1 m\"\n"
              "polygon = [[\"50 m\", \"0 m\"], [\"60 m\", \"9 m\"], [\"60 m\", \"0 m\"], [\"50 m\", \"9 "
              "m\"]]\n[[fix]]",
              "s.toml:18:11: error: polygon: its sides 1 and 3 cross; give the corners in order round the "
              "shape\n"
              "   18 | polygon = [[\"50 m\", \"0 m\"], [\"60 m\", \"9 m\"], [\"60 m\", \"0 m\"], [\"50 m\", "
              "\"9 m\"]]\n"
              "      |           ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^"},
        Wrong{"OverlappingBodies", "[[fix]]",
              "[[body]]\nmaterial = \"concrete\"\nspacing = \"1 m\"\nbox = [[\"39.9 m\", \"0 m\"], [\"41.9 "
              "m\", \"1 m\"]]\n[[fix]]",
              "s.toml:15:1: error: [[body]]: body \"body2\" overlaps body \"plate\"\n"
              "   15 | [[body]]\n"
              "      | ^^^^^^^^ bodies may touch, not overlap"},
        Wrong{"BoxThatNoSpacingFits", "spacing = \"4 m\"", "spacing = \"3 m\"",
              "s.toml:14:11: error: [[body]] spacing: the box is 40 m x 20 m, 13.3333 x 6.66667 spacings of "
              "3 m; both "
              "need to be whole numbers\n"
              "   14 | spacing = \"spacing\"\n"
              "      |           ^^^^^^^^^ the nearest spacing that fits: \"2.85714285714 m\""},
        Wrong{"OddFrameSize", "[run]", "[view]\nsize = [1921, 1080]\n[run]",
              "s.toml:25:9: error: [view] size: 1921 pixels; a film needs even numbers\n"
              "   25 | size = [1921, 1080]\n"
              "      |         ^^^^ for example 1922"},
        Wrong{"UnknownEvent", "separation + 0.5 s", "seperation + 0.5 s",
              "s.toml:25:10: error: [run] until: unknown event \"seperation\"\n"
              "   25 | until = \"seperation + 0.5 s\"\n"
              "      |          ^^^^^^^^^^ did you mean \"separation\"?"},
        Wrong{
            "EventThatCannotHappen", "break_strain = 0.1", "",
            "s.toml:25:9: error: [run] until: separation cannot happen: no material of this scene can break\n"
            "   25 | until = \"separation + 0.5 s\"\n"
            "      |         ^^^^^^^^^^^^^^^^^^^^ add break_strain or fracture_energy to a material"},
        Wrong{"EventWithoutASupport",
              "[[fix]]\nname = \"clamp\"\nwhere = \"x < spacing\"\nhold = [\"x\", \"y\"]\n", "",
              "s.toml:21:9: error: [run] until: separation cannot happen: this scene holds no particle, so "
              "nothing can be "
              "separated from a support\n"
              "   21 | until = \"separation + 0.5 s\"\n"
              "      |         ^^^^^^^^^^^^^^^^^^^^ add a [[fix]]"},
        Wrong{"TooLargeANumber", "= 0.1", "= 1e400",
              "s.toml:9:16: error: cannot read \"1e400\" as a value\n"
              "    9 | break_strain = 1e400\n"
              "      |                ^^^^^ a number must fit into double precision; a text stands in "
              "\"quotes\""},
        Wrong{"TooLargeANumberInAText", "\"210 MPa\"", "\"1e400 MPa\"",
              "s.toml:7:19: error: [material.concrete] youngs_modulus: \"1e400\" is too large or too small\n"
              "    7 | youngs_modulus = \"1e400 MPa\"\n"
              "      |                   ^^^^^"},
        Wrong{"Infinity", "= 0.1", "= inf",
              "s.toml:9:16: error: [material.concrete] break_strain needs a finite number\n"
              "    9 | break_strain = inf\n"
              "      |                ^^^ for example: break_strain = 0.1"},
        Wrong{"DuplicateNames", "[[load]]",
              "[[fix]]\nname = \"clamp\"\nwhere = \"x < 9 m\"\nhold = [\"x\"]\n[[load]]",
              "s.toml:20:8: error: [[fix]] name \"clamp\" is taken already\n"
              "   20 | name = \"clamp\"\n"
              "      |        ^^^^^^^ give it another name"},
        Wrong{"NotchOutside", "[[fix]]",
              "[[notch]]\nline = [[\"50 m\", \"0 m\"], [\"50 m\", \"5 m\"]]\n[[fix]]",
              "s.toml:15:1: error: [[notch]]: \"notch1\" cuts no bond\n"
              "   15 | [[notch]]\n"
              "      | ^^^^^^^^^ it lies outside the bodies, or in a corner where no bond is"},
        Wrong{"TimeStepAboveTheLimit", "[run]", "[run]\ntime_step = \"1 s\"",
              "s.toml:25:13: error: [run] time_step: 1 s is above the stable 0.0119 s\n"
              "   25 | time_step = \"1 s\"\n"
              "      |             ^^^^^ leave it out to have it chosen"},
        Wrong{"MissingKey", "density = \"2300 kg/m^3\"", "",
              "s.toml:5:1: error: missing key \"density\" in [material.concrete]\n"
              "    5 | [material.concrete]\n"
              "      | ^^^^^^^^^^^^^^^^^^^ for example: density = \"2300 kg/m^3\""},
        Wrong{"NotAvailableYet", "[run]", "[contact]\n[run]",
              "s.toml:24:2: error: [contact]: not available yet\n"
              "   24 | [contact]\n"
              "      |  ^^^^^^^ leave it out"},
        Wrong{"ThreeDimensions", "[run]", "[model]\ndimension = 3\n[run]",
              "s.toml:25:13: error: [model] dimension: three dimensions are not available yet\n"
              "   25 | dimension = 3\n"
              "      |             ^"},
        Wrong{"WrongBrackets", "[[fix]]", "[fix]",
              "s.toml:15:2: error: [fix] stands where a block is expected\n"
              "   15 | [fix]\n"
              "      |  ^^^ write [[fix]]"},
        Wrong{"AUnitInATableOfOneLine", "[run]",
              "[movie]\nslow = [{ span = \"1 q\", around = \"first_break\", rate = 0.1 }]\n[run]",
              "s.toml:25:21: error: [movie] slow span: unknown unit \"q\"\n"
              "   25 | slow = [{ span = \"1 q\", around = \"first_break\", rate = 0.1 }]\n"
              "      |                     ^ capitals matter: m, mm, s, ms, kg, N, kN, MN, Pa, MPa, GPa, J"},
        Wrong{"ADate", "\"60 s\"", "1979-05-27",
              "s.toml:26:12: error: [run] max_time needs a time (s); found a date or time of day\n"
              "   26 | max_time = 1979-05-27\n"
              "      |            ^^^^^^^^^^ for example: max_time = \"60 s\""},
        Wrong{"AWordThatDampingDoesNotKnow", "version = 1", "damping = \"static\"",
              "s.toml:1:1: error: damping = ... stands where a block is expected\n"
              "    1 | damping = \"static\"\n"
              "      | ^^^^^^^ write [damping], or damping = \"quasi-static\""},
        Wrong{"AWordForDampingInsideABlock", "ramp = \"40 s\"", "damping = \"quasi-static\"",
              "s.toml:23:1: error: unknown key \"damping\" in [[load]]\n"
              "   23 | damping = \"quasi-static\"\n"
              "      | ^^^^^^^ it stands at the top of the file, above the first block"},
        Wrong{"AFreePartWithADampingRatio", "hold = [\"x\", \"y\"]", "hold = [\"x\"]\n[damping]\nratio = 0.3",
              "s.toml:20:9: error: [damping] ratio: the part of the model at (2 m, 2 m) can move freely, "
              "so there is no "
              "first mode\n"
              "   20 | ratio = 0.3\n"
              "      |         ^^^ give a rate, for example: rate = \"0.5 s^-1\"; or hold every part in "
              "[[fix]]"}),
    [](const auto& test) { return std::string(test.param.name); });

TEST(SceneErrors, ACharacterWithoutAGlyphIsToldWhereItStands) {
    EXPECT_EQ(answer(replaced(small_scene, "\"small\"", "\"Beam 한국 🔨\"")),
              "s.toml:2:18: error: title: no built-in font has \"🔨\" (U+1F528)\n"
              "    2 | title = \"Beam 한국 🔨\"\n"
              "      |                    ^^ leave the character out, or write a word");
    const std::string named =
        replaced(replaced(small_scene, "[material.concrete]", "[material.\"c🔨\"]"), "\"concrete\"", "\"c🔨\"");
    EXPECT_NE(answer(named).find("s.toml:5:11: error: [material.c🔨]: no built-in font has \"🔨\" (U+1F528)"),
              std::string::npos)
        << answer(named);
    EXPECT_EQ(answer(replaced(small_scene, "\"small\"", "\"كسر اللوح, 압축, 压缩, दरार\"")), "");
}

TEST(SceneErrors, AFilesNameThatStandsAsTitleNeedsGlyphsToo) {
    const std::string untitled = replaced(small_scene, "title = \"small\"\n", "");
    EXPECT_EQ(parse_scene(untitled, "קורה.toml").title, "קורה");
    try {
        parse_scene(untitled, "🔨.toml");
        FAIL();
    } catch (const SceneErrors& errors) {
        EXPECT_NE(std::string(errors.what()).find("title, which is the file's name: no built-in font has"),
                  std::string::npos)
            << errors.what();
    }
}

TEST(SceneErrors, AllMistakesComeInOneGoSortedByPlace) {
    std::string text = replaced(small_scene, "\"60 s\"", "\"60 m\"");
    text = replaced(text, "\"210 MPa\"", "\"210 MN\"");
    text = replaced(text, "title", "titel");
    text = replaced(text, "x > 40 m - spacing", "x > 41 m");
    const std::string found = answer(text);
    std::vector<std::string> places;
    for (std::size_t at = found.find("s.toml:"); at != std::string::npos; at = found.find("s.toml:", at + 1))
        places.push_back(found.substr(at, found.find(": error", at) - at));
    EXPECT_EQ(places, (std::vector<std::string>{"s.toml:2:1", "s.toml:7:18", "s.toml:21:9", "s.toml:26:12"}))
        << found;
}

TEST(SceneErrors, AMistakeIsNotToldAgainByWhatFollowsFromIt) {
    const std::string found = answer(replaced(small_scene, "spacing = \"4 m\"", "spacing = \"4 q\""));
    EXPECT_EQ(found,
              "s.toml:4:14: error: [params] spacing: unknown unit \"q\"\n"
              "    4 | spacing = \"4 q\"\n"
              "      |              ^ capitals matter: m, mm, s, ms, kg, N, kN, MN, Pa, MPa, GPa, J");
}

TEST(SceneErrors, TheCaretStandsRightBehindWideLetters) {
    const std::string found =
        answer(replaced(small_scene, "name = \"plate\"", "name = \"ひび\" \nnmae = \"割れ\""));
    EXPECT_EQ(found,
              "s.toml:12:1: error: unknown key \"nmae\" in [[body]]; did you mean \"name\"?\n"
              "   12 | nmae = \"割れ\"\n"
              "      | ^^^^");
    const std::string wide =
        answer(replaced(small_scene, "hold = [\"x\", \"y\"]", "hold = [\"割れ\", \"y\"]"));
    EXPECT_EQ(wide,
              "s.toml:18:9: error: [[fix]] hold: no \"割れ\"\n"
              "   18 | hold = [\"割れ\", \"y\"]\n"
              "      |         ^^^^^^ known: x, y, z");
}

#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__)
constexpr double longest_answer = 0.9;  // s of processor time: a busy machine makes nothing longer
#else
constexpr double longest_answer = 9;
#endif

/// A folder of its own for the files of one test.
class WrongFile : public testing::Test {
 protected:
    void SetUp() override {
        folder_ = std::filesystem::temp_directory_path() /
                  ("hibi_wrong_" + std::to_string(::getpid()) + "_" +
                   testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }
    /// The answer to a file of this content; it must come well within a second.
    std::string answer_to(const std::string& content) {
        std::ofstream(folder_ / "s.toml", std::ios::binary) << content;
        return answer_to_file("s.toml");
    }
    std::string answer_to_file(const std::string& name) {
        const std::clock_t begin = std::clock();
        std::string what;
        try {
            read_scene(folder_ / name);
        } catch (const SceneErrors& errors) {
            what = errors.what();
        }
        EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, longest_answer) << name;
        const std::size_t path = what.find(folder_.string() + "/");
        if (path == 0) what.erase(0, folder_.string().size() + 1);
        return what.substr(0, what.find('\n'));
    }
    std::filesystem::path folder_;
};

TEST_F(WrongFile, ThatIsNotThere) {
    EXPECT_EQ(answer_to_file("none.toml"),
              "none.toml: error: cannot open it: No such file or directory; `hibi new` writes a scene to "
              "start from");
}

TEST_F(WrongFile, ThatIsAFolder) {
    std::filesystem::create_directory(folder_ / "f.toml");
    EXPECT_EQ(answer_to_file("f.toml"), "f.toml: error: this is a folder; name the scene file in it");
}

TEST_F(WrongFile, ThatIsBinary) {
    std::string bytes;
    for (int i = 0; i < 4096; ++i) bytes += static_cast<char>((i * 7919) >> 3);
    EXPECT_EQ(answer_to("\n" + bytes), "s.toml:2:1: error: byte 0x00: this is not a text file");
    EXPECT_EQ(answer_to("title = \"caf\xe9\""), "s.toml:1:13: error: byte 0xe9: this is not a text file");
    EXPECT_EQ(answer_to("a = \"\xed\xa0\x80\""), "s.toml:1:6: error: byte 0xed: this is not a text file");
}

TEST_F(WrongFile, OfTenMegabytesOfBrackets) {
    EXPECT_EQ(answer_to("a = " + std::string(10'000'000, '[')),
              "s.toml:1:37: error: brackets nest more than 32 deep");
    EXPECT_EQ(answer_to(std::string(10'000'000, '[')), "s.toml:1:33: error: brackets nest more than 32 deep");
    EXPECT_EQ(
        answer_to("a = \"" + std::string(10'000'000, '(') + "\"").find("s.toml:1:1: error: unknown key"), 0u);
}

TEST_F(WrongFile, WithADottedKeyWithoutEnd) {
    std::string key = "a";
    for (int i = 0; i < 200000; ++i) key += ".a";
    EXPECT_EQ(answer_to(key + " = 1"), "s.toml:1:34: error: a dotted key of more than 16 parts");
    EXPECT_EQ(answer_to("[" + key + "]"), "s.toml:1:35: error: a dotted key of more than 16 parts");
}

TEST_F(WrongFile, WithTwentyThousandMistakes) {
    std::string keys, points = "[[body]]\npolygon = [";
    for (int i = 0; i < 20000; ++i) {
        keys += std::to_string(i) + " = 1\n";
        points += "[\"1 q\", 1],";
    }
    EXPECT_EQ(answer_to(keys), "s.toml:1:1: error: unknown key \"0\" at the top of the file");
    EXPECT_EQ(answer_to(points + "]"), "s.toml:1:1: error: missing key \"material\" in [[body]]");
}

TEST_F(WrongFile, ThatIsTooLarge) {
    EXPECT_EQ(answer_to(std::string(20'000'000, '#')),
              "s.toml: error: a scene file of more than 16 MB; is this the right file?");
}

TEST_F(WrongFile, ThatIsEmpty) {
    EXPECT_EQ(answer_to(""), "s.toml:1:1: error: missing block [run]");
    EXPECT_EQ(answer_to("[[["),
              "s.toml:1:3: error: not TOML: in a key: expected bare key starting character or string "
              "delimiter, saw '['");
    EXPECT_EQ(answer_to("[="),
              "s.toml:1:2: error: not TOML: in a key: expected bare key starting character or string "
              "delimiter, saw '='");
    EXPECT_EQ(answer_to("title = \"a\\u0000b\""), "s.toml:1:9: error: control character \\u0000 in a text");
}

}  // namespace
}  // namespace hibi
