// The program as a user calls it: one small scene from file to film, and what must not change it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>

#include "base/hash.hpp"
#include "record/run_folder.hpp"
#include "support/call.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

Answer hibi(const std::string& arguments, const std::string& environment = {}) {
    return call(environment + " " HIBI_PROGRAM " " + arguments);
}

using Edits = std::vector<std::pair<std::string, std::string>>;  ///< regular expression, replacement

/// A copy of a scene, each expression replaced; it must be there.
fs::path edited(const fs::path& scene, const fs::path& copy, const Edits& edits) {
    std::string text = text_of(scene);
    for (const auto& [from, to] : edits) {
        EXPECT_TRUE(std::regex_search(text, std::regex(from))) << from;
        text = std::regex_replace(text, std::regex(from), to);
    }
    std::ofstream(copy) << text;
    return copy;
}

/// The fine cantilever with 20 x 10 particles and a small, short film.
fs::path small_scene(const fs::path& folder) {
    return edited(fs::path(HIBI_SOURCE_DIR) / "scenes/bending_fine.toml", folder / "small.toml",
                  {{"spacing = \"1 m\"", "spacing = \"2 m\""},
                   {"\\[view\\]", "[movie]\nduration = \"2 s\"\n\n[view]\nsize = [320, 180]"}});
}

/// Hashes of all frames and of all states of a run.
std::string prints_of(const fs::path& run) {
    std::string all;
    for (const auto& frame : nlohmann::json::parse(text_of(run / "frames.json")))
        all += frame["sha256"].get<std::string>();
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(run / "states")) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) all += file.filename().string() + sha256(text_of(file));
    return sha256(all);
}

class Film : public testing::Test {
 protected:
    static void SetUpTestSuite() {
        folder_ = fs::temp_directory_path() / ("hibi-film-" + std::to_string(getpid()));
        fs::create_directories(folder_);
        scene_ = small_scene(folder_);
        run_ = folder_ / "run";
        const Answer answer = hibi("run " + scene_.string() + " -q -o " + run_.string());
        ASSERT_EQ(answer.status, 0) << answer.out;
    }
    static void TearDownTestSuite() { fs::remove_all(folder_); }

    static inline fs::path folder_, scene_, run_;
};

TEST_F(Film, LeavesEveryFileOfTheContract) {
    for (const char* name :
         {"movie.mp4", "frames/000000.png", "frames/000049.png", "frames.json", "poster.png", "history.csv",
          "breaks.csv", "states.hdf.series", "scene.toml", "run.json", "strip.png", "cracks.png", "curve.png",
          "curve.svg", "report.html", "caption.md", "snippets/figure.tex", "figures/strip_print_85mm.png"})
        EXPECT_TRUE(fs::exists(run_ / name)) << name;
    EXPECT_FALSE(fs::exists(run_ / "frames/000050.png"));
    for (const auto& entry : fs::recursive_directory_iterator(run_))
        EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
}

TEST_F(Film, SameBitsAgainWithOtherThreadsVectorsAndBackEnd) {
    const std::string first = prints_of(run_);
    const std::vector<std::pair<std::string, std::string>> ways = {{"--threads 1", ""},
                                                                   {"--threads 2", "LP_NUM_THREADS=0"},
                                                                   {"--threads 3", "LP_NUM_THREADS=1"},
                                                                   {"--gl egl", "LP_NUM_THREADS=2"}};
    for (const auto& [arguments, environment] : ways) {
        const fs::path other = folder_ / "other";
        const Answer answer =
            hibi("run " + scene_.string() + " -q --no-report --force -o " + other.string() + " " + arguments,
                 environment);
        ASSERT_EQ(answer.status, 0) << answer.out;
        EXPECT_EQ(prints_of(other), first) << environment << " " << arguments;
    }
}

TEST_F(Film, SameStatesOfALargerPlateForOneTwoAndThreeThreads) {
    // 5000 particles, more than are left to one thread; weak, so that bonds break in the first steps.
    const fs::path scene = edited(scene_, folder_ / "larger.toml",
                                  {{"break_strain   = 0.1", "break_strain = 1e-5"},
                                   {"until    = \"separation . 0.5 s\"\n", ""},
                                   {"max_time = \"60 s\"", "max_time = \"0.06 s\""},
                                   {"\nratio = 0.3", "\nrate = 2"}});
    std::set<std::string> prints;
    for (const char* threads : {"1", "2", "3"}) {
        const fs::path other = folder_ / "larger";
        const Answer answer =
            hibi("run " + scene.string() + " -q --no-report --force -p spacing=0.4m --threads " + threads +
                 " -o " + other.string());
        ASSERT_EQ(answer.status & ~4, 0) << answer.out;
        EXPECT_GT(RunReader(other).summary().broken, 10);
        prints.insert(prints_of(other));
    }
    EXPECT_EQ(prints.size(), 1u);
}

TEST_F(Film, TheSceneAndStrangersFilesAreNeverOverwritten) {
    const fs::path folder = folder_ / "strange";
    fs::create_directories(folder);
    fs::copy_file(scene_, folder / "scene.toml");
    const std::string before = text_of(folder / "scene.toml");
    Answer answer =
        hibi("run " + (folder / "scene.toml").string() + " -q --no-report --force -o " + folder.string());
    EXPECT_EQ(answer.status, 1) << answer.out;
    EXPECT_EQ(text_of(folder / "scene.toml"), before);
    fs::remove(folder / "scene.toml");
    std::ofstream(folder / "notes.txt") << "mine";
    answer = hibi("run " + scene_.string() + " -q --no-report -o " + folder.string());
    EXPECT_EQ(answer.status, 1) << answer.out;
    EXPECT_EQ(text_of(folder / "notes.txt"), "mine");
    EXPECT_FALSE(fs::exists(folder / "run.json"));
}

TEST_F(Film, ARunThatWasKilledIsDrawnFromWhatItLeft) {
    const fs::path copy = folder_ / "killed";
    fs::copy(run_, copy, fs::copy_options::recursive);
    for (const char* name :
         {"frames", "frames.json", "movie.mp4", "poster.png", "run.json", "states.hdf.series"})
        fs::remove_all(copy / name);
    const Answer answer = hibi("render -q --no-report " + copy.string());
    EXPECT_EQ(answer.status, 0) << answer.out;
    EXPECT_TRUE(fs::exists(copy / "movie.mp4"));
    EXPECT_TRUE(RunReader(copy).summary().events.first_break);
    EXPECT_FALSE(RunReader(copy).summary().trusted);
}

TEST_F(Film, SeparationOfWhatNeverHeldTogetherIsAnErrorBeforeTheRun) {
    const fs::path scene = edited(
        scene_, folder_ / "apart.toml",
        {{"\nratio = 0.3", "\nrate = 2"},
         {"\\[damping\\]", "[[notch]]\nline = [[\"20 m\", \"-1 m\"], [\"20 m\", \"21 m\"]]\n\n[damping]"}});
    const Answer answer =
        hibi("run " + scene.string() + " -q --no-report -o " + (folder_ / "apart").string());
    EXPECT_EQ(answer.status, 2) << answer.out;
    EXPECT_NE(answer.out.find("separation cannot happen"), std::string::npos) << answer.out;
    EXPECT_FALSE(fs::exists(folder_ / "apart"));
}

TEST_F(Film, RenderDrawsTheSameFramesFromStatesAlone) {
    const fs::path copy = folder_ / "copy";
    fs::copy(run_, copy, fs::copy_options::recursive);
    const std::string first = prints_of(copy);
    for (const char* name : {"frames", "frames.json", "movie.mp4", "poster.png"}) fs::remove_all(copy / name);
    const Answer answer = hibi("render -q --no-report " + copy.string());
    ASSERT_EQ(answer.status, 0) << answer.out;
    EXPECT_EQ(prints_of(copy), first);
    EXPECT_TRUE(fs::exists(copy / "movie.mp4"));
}

TEST_F(Film, StatesAndFramesAgreeWithTheListOfBreaks) {
    std::map<int, double> breaks;  // bond -> time
    std::ifstream csv(run_ / "breaks.csv");
    for (std::string line; std::getline(csv, line);) {
        if (line.empty() || line[0] == '#' || line.starts_with("time")) continue;
        double time;
        int bond;
        ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%d", &time, &bond), 2) << line;
        breaks[bond] = time;
    }
    ASSERT_GT(breaks.size(), 20u);
    const auto broken_by = [&](double time) {
        return std::count_if(breaks.begin(), breaks.end(), [&](const auto& b) { return b.second <= time; });
    };
    const RunReader reader(run_);
    ASSERT_GT(reader.states().size(), 50u);
    for (std::size_t k = 0; k < reader.states().size(); ++k) {
        const Snapshot state = reader.read(static_cast<int>(k));
        ASSERT_EQ(static_cast<long>(state.broken.size()), broken_by(state.time)) << k;
        for (std::size_t b = 0; b < state.broken.size(); ++b)
            EXPECT_EQ(state.broken_at[b], breaks.at(state.broken[b]));
    }
    for (const auto& [bond, time] : breaks) EXPECT_EQ(reader.broken_at()[bond], time);
    const auto frames = nlohmann::json::parse(text_of(run_ / "frames.json"));
    ASSERT_EQ(frames.size(), 50u);
    for (const auto& frame : frames)
        EXPECT_EQ(frame["broken"].get<long>(), broken_by(frame["time"])) << frame;
}

TEST_F(Film, TheFailureFillsAtLeastAThirdAndEveryFrameOfItShowsSomethingNew) {
    const auto events = nlohmann::json::parse(text_of(run_ / "run.json"))["events"];
    const double begin = events["first_break"]["time"], end = events["separation"]["time"];
    int during = 0, changed = 0;
    std::string last;
    for (const auto& frame : nlohmann::json::parse(text_of(run_ / "frames.json"))) {
        if (frame["time"] >= begin && frame["time"] <= end) {
            ++during;
            changed += frame["sha256"].get<std::string>() != last;
        }
        last = frame["sha256"].get<std::string>();
    }
    EXPECT_GE(3 * during, 49);  // of 50 frames; begin and end may fall between two
    EXPECT_EQ(changed, during);
}

TEST_F(Film, IsAnH264FilmOfTheRightLengthForEveryPlayer) {
    const Answer answer =
        call("ffprobe -v error -count_frames -print_format json -show_streams -show_format " +
             (run_ / "movie.mp4").string());
    ASSERT_EQ(answer.status, 0) << answer.out;
    const auto stream = nlohmann::json::parse(answer.out)["streams"][0];
    EXPECT_EQ(stream["codec_name"], "h264");
    EXPECT_EQ(stream["pix_fmt"], "yuv420p");
    for (const char* tag : {"color_space", "color_transfer", "color_primaries"})
        EXPECT_EQ(stream[tag], "bt709");
    EXPECT_EQ(stream["r_frame_rate"], "25/1");
    EXPECT_EQ(stream["avg_frame_rate"], "25/1");
    EXPECT_EQ(stream["nb_read_frames"], "50");
    EXPECT_EQ(stream["width"], 320);
    EXPECT_NEAR(std::stod(stream["duration"].get<std::string>()), 2, 1e-6);
}

TEST_F(Film, PlaysAndSeeksInABrowser) {
    const Answer answer =
        call("node " HIBI_WEB "/film_check.mjs " + (run_ / "movie.mp4").string() + " 320 180 2");
    EXPECT_EQ(answer.status, 0) << answer.out;
}

TEST_F(Film, ItsReportIsReadInABrowserWithoutANetwork) {
    const Answer answer = call("node " HIBI_WEB "/report_check.mjs " + (run_ / "report.html").string());
    EXPECT_EQ(answer.status, 0) << answer.out;
}

TEST_F(Film, EveryFileSaysWhichCommandMadeIt) {
    const std::string command = "hibi run " + scene_.string() + " -o " + run_.string() + "\n";
    for (const char* name :
         {"movie.mp4", "frames/000007.png", "poster.png", "strip.png", "cracks.png", "curve.png",
          "curve.svg", "figures/strip_print_85mm.png", "history.csv", "caption.md", "breaks.csv", "report.html", "run.json", "."}) {
        const Answer answer = hibi("reproduce " + (run_ / name).string());
        EXPECT_EQ(answer.status, 0) << name;
        EXPECT_EQ(answer.out, command) << name;
    }
    EXPECT_EQ(hibi("reproduce " + scene_.string()).status, 2);
    // What was made of the run later: that command stands behind the run's.
    const std::string strip = (folder_ / "strip.png").string(), setup = (folder_ / "setup.png").string();
    ASSERT_EQ(hibi("strip " + run_.string() + " --theme light --width 50 -o " + strip).status, 0);
    EXPECT_EQ(hibi("reproduce " + strip).out, command.substr(0, command.size() - 1) + " && hibi strip " +
                                                  run_.string() + " --theme light --width 50 -o " + strip +
                                                  "\n");
    ASSERT_EQ(hibi("preview " + scene_.string() + " -o " + setup).status, 0);
    EXPECT_EQ(hibi("reproduce " + setup).out, "hibi preview " + scene_.string() + " -o " + setup + "\n");
}

TEST_F(Film, ANumberWithoutItsUnitIsNoted) {
    const std::string out = (folder_ / "plain").string();
    const Answer answer = hibi("run " + scene_.string() + " -p spacing=4 --no-pictures -q -o " + out);
    EXPECT_EQ(answer.status, 0);
    EXPECT_NE(answer.out.find("note: spacing = 4 has no unit and is taken in SI; the scene says 2 m"),
              std::string::npos)
        << answer.out;
}

TEST_F(Film, ReproduceNotesThatTheSceneHasChangedSince) {
    const fs::path scene = edited(scene_, folder_ / "changing.toml", {});
    const fs::path folder = folder_ / "changing";
    ASSERT_EQ(
        hibi("run " + scene.string() + " -p spacing='4 m' --no-pictures -q -o " + folder.string()).status, 0);
    EXPECT_EQ(hibi("reproduce " + folder.string()).out,
              "hibi run " + scene.string() + " -p 'spacing=4 m' -o " + folder.string() + "\n");
    edited(scene_, scene, {{"-80 MN", "-81 MN"}});
    EXPECT_NE(hibi("reproduce " + folder.string()).out.find("is another scene by now"), std::string::npos);
    fs::remove(scene);
    EXPECT_NE(hibi("reproduce " + folder.string()).out.find("is not here"), std::string::npos);
}

TEST_F(Film, TheSceneAsRunGivesTheSameRun) {
    const fs::path other = folder_ / "again";
    const Answer answer =
        hibi("run " + (run_ / "scene.toml").string() + " -q --no-report -o " + other.string());
    ASSERT_EQ(answer.status, 0) << answer.out;
    EXPECT_EQ(prints_of(other), prints_of(run_));
}

TEST_F(Film, AnotherScenesRunIsNotOverwritten) {
    const fs::path other = folder_ / "other_scene.toml";
    fs::copy_file(scene_, other);
    const std::string before = text_of(run_ / "run.json");
    const Answer answer = hibi("run " + other.string() + " -q -o " + run_.string());
    EXPECT_EQ(answer.status, 1);
    EXPECT_NE(answer.out.find("--force"), std::string::npos) << answer.out;
    EXPECT_EQ(text_of(run_ / "run.json"), before);
}

TEST_F(Film, AnEventThatIsNotReachedIsAWarningAndNull) {
    const fs::path folder = folder_ / "short";
    const fs::path scene =
        edited(scene_, folder_ / "short.toml", {{"max_time = \"60 s\"", "max_time = \"2 s\""}});
    const Answer answer = hibi("run " + scene.string() + " --no-pictures -q -o " + folder.string());
    EXPECT_EQ(answer.status, 0) << answer.out;
    EXPECT_NE(answer.out.find("separation was not reached"), std::string::npos) << answer.out;
    const auto run = nlohmann::json::parse(text_of(folder / "run.json"));
    EXPECT_TRUE(run["events"]["separation"].is_null());
    EXPECT_TRUE(run["events"]["first_break"].is_null());
    EXPECT_TRUE(run["energy"]["trusted"].get<bool>());
}

TEST_F(Film, ARunThatBlowsUpKeepsWhatItRecordedAndSaysWhy) {
    const fs::path folder = folder_ / "wild";
    const fs::path scene = edited(scene_, folder_ / "wild.toml",
                                  {{"-80 MN", "-80 MN * (t / 1 s)^160"},
                                   {"break_strain   = 0.1", ""},
                                   {"until    = \"separation . 0.5 s\"\n", ""},
                                   {"until = \"separation\"\n", ""}});
    const Answer answer = hibi("run " + scene.string() + " -q --no-report -o " + folder.string());
    EXPECT_EQ(answer.status, 1);
    EXPECT_TRUE(std::regex_search(answer.out, std::regex("step [0-9]+, t = .* s: .*; .*stretched")))
        << answer.out;
    const auto run = nlohmann::json::parse(text_of(folder / "run.json"));
    EXPECT_TRUE(run["stopped"].is_string());
    EXPECT_GT(RunReader(folder).states().size(), 1u);
    EXPECT_EQ(text_of(folder / "history.csv").find("nan"), std::string::npos);
}

}  // namespace
}  // namespace hibi
