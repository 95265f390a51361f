// Files as a user names them: folders whose names mean something to a library, and scenes that come from a
// pipe.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "record/files.hpp"
#include "record/provenance.hpp"
#include "scene/everything.hpp"
#include "scene/read.hpp"
#include "support/call.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;

/// A film of one second of a run that ends soon.
std::string short_scene() {
    std::string text = small_scene;
    text.replace(text.find("\"60 s\""), 6, "\"1 s\"");
    text.replace(text.find("until = \"separation + 0.5 s\"\n"), 29, "");
    return text + "[view]\nsize = [128, 96]\n[movie]\nduration = 1\nfps = 5\n";
}

class Names : public testing::Test {
 protected:
    void SetUp() override { std::ofstream(folder_.path() / "beam.toml") << short_scene(); }
    /// Words of a shell in bash, where `hibi` is the program.
    Answer shell(const std::string& command) const {
        return call("cd " + folder_.path().string() + " && hibi() { " HIBI_PROGRAM " \"$@\"; } && " +
                    command);
    }
    bool is_there(const std::string& name) const { return fs::exists(folder_.path() / name); }

    TemporaryFolder folder_;
};

TEST_F(Names, EveryFileOfARunIsMadeAndReadInAFolderOfAnyName) {
    for (const std::string name : {"12:30", "file:x/%03d", "-it's \"so\" 割れ"}) {
        SCOPED_TRACE(name);
        const std::string quoted = shell_command({name}), path = shell_command({path_word(name)});
        Answer answer = shell("hibi run beam.toml -q --formats mp4,gif,webm,apng,webp --output=" + quoted);
        ASSERT_EQ(answer.status & ~4, 0) << answer.out;
        for (const char* file : {"movie.mp4", "movie.gif", "movie.webm", "movie.apng", "movie.webp",
                                 "frames/000001.png", "curve.svg", "report.html"}) {
            EXPECT_TRUE(is_there(name + "/" + file));
            answer = shell("hibi reproduce -- " + shell_command({name + "/" + file}));
            EXPECT_EQ(answer.out, "hibi run beam.toml -o " + path + "\n") << file;
        }
        EXPECT_EQ(shell("hibi render -q --formats gif -- " + quoted).status, 0);
        const std::string twice = path + " " + path;
        answer = shell("hibi compare -q --force --formats mp4,gif " + twice + " -o " +
                       shell_command({path_word(name + ":compared")}));
        EXPECT_EQ(answer.status, 0) << answer.out;
        EXPECT_TRUE(is_there(name + ":compared/movie.gif"));
        answer = shell("hibi diff " + twice + " -o " + shell_command({path_word(name + ":diff")}));
        EXPECT_EQ(answer.status, 0) << answer.out;
        EXPECT_TRUE(is_there(name + ":diff/flicker.apng"));
    }
}

TEST_F(Names, ASceneMayComeFromAPipe) {
    for (const std::string source :
         {"hibi CMD /dev/stdin", "hibi CMD -", "hibi CMD /dev/fd/0", "hibi CMD /proc/self/fd/0"})
        for (const std::string command : {"check", "preview"}) {
            std::string words = source;
            words.replace(words.find("CMD"), 3, command);
            const Answer answer = shell("cat beam.toml | " + words);
            EXPECT_EQ(answer.status, 0) << words << answer.out;
        }
    Answer answer = shell("cat beam.toml | hibi run - -q --no-pictures -p spacing=5");
    EXPECT_EQ(answer.status & ~4, 0) << answer.out;
    // What is said of the overrides is said of the scene that was read.
    EXPECT_NE(answer.out.find("/dev/stdin: note: spacing = 5 has no unit"), std::string::npos) << answer.out;
    EXPECT_TRUE(is_there("out/stdin/run.json"));
    answer = shell("bash -c '" HIBI_PROGRAM " run <(cat beam.toml) -q --no-pictures'");
    EXPECT_EQ(answer.status & ~4, 0) << answer.out;
    EXPECT_TRUE(is_there("out/pipe/run.json"));
    answer =
        shell("mkfifo slow.toml && { cat beam.toml > slow.toml & } && hibi run slow.toml -q --no-pictures");
    EXPECT_EQ(answer.status & ~4, 0) << answer.out;
    EXPECT_TRUE(is_there("out/slow/run.json"));
    answer = shell("hibi run - -q --no-pictures -o from_file < beam.toml");
    EXPECT_EQ(answer.status & ~4, 0) << answer.out;
    // The same run as that of the file.
    ASSERT_EQ(shell("hibi run beam.toml -q --no-pictures").status & ~4, 0);
    EXPECT_EQ(shell("hibi diff from_file out/beam").out.find("same (identical)"), 0u);
    EXPECT_EQ(shell("sed s/-80/-80x/ beam.toml | hibi check -").status, 2);
    EXPECT_NE(shell("sed s/-80/-80x/ beam.toml | hibi check -").out.find("/dev/stdin:22:"),
              std::string::npos);
}

TEST_F(Names, TheRunOfASceneFromAPipeIsReproducedFromItsFolder) {
    ASSERT_EQ(shell("cat beam.toml | hibi run - -q --no-pictures -p spacing=5m -o piped").status & ~4, 0);
    const Answer answer = shell("hibi reproduce piped/history.csv");
    EXPECT_EQ(answer.status, 0);
    EXPECT_EQ(answer.out, "cat piped/scene.toml | hibi run /dev/stdin -o piped\n");
    fs::copy(folder_.path() / "piped", folder_.path() / "before", fs::copy_options::recursive);
    const Answer again = shell("cat piped/scene.toml | hibi run /dev/stdin -q --no-pictures -o piped");
    ASSERT_EQ(again.status & ~4, 0) << again.out;
    EXPECT_EQ(shell("hibi diff before piped").out.find("same (identical)"), 0u);
    // Another scene has no name by which it could be told from this one.
    Answer other = shell("cat beam.toml | hibi run - -q --no-pictures -o piped");
    EXPECT_EQ(other.status, 1);
    EXPECT_NE(other.out.find("holds the run of another scene, /dev/stdin"), std::string::npos) << other.out;
    EXPECT_EQ(shell("cat beam.toml | hibi run - -q --no-pictures -o piped --force").status & ~4, 0);
    fs::remove(folder_.path() / "before/scene.toml");
    fs::rename(folder_.path() / "piped/scene.toml", folder_.path() / "gone.toml");
    EXPECT_NE(shell("hibi reproduce piped").out.find("piped/scene.toml is not here"), std::string::npos);
    ASSERT_EQ(shell("cat beam.toml | hibi preview - -o setup.png").status, 0);
    EXPECT_NE(shell("hibi reproduce setup.png").out.find("/dev/stdin was a pipe, and what it held is gone"),
              std::string::npos);
}

TEST_F(Names, WhatReadsASceneManyTimesRefusesAPipeInWords) {
    for (const std::string command : {"sweep - -p spacing=4m,5m", "converge - -p spacing=4m,5m", "test -",
                                      "sweep /dev/stdin -p spacing=4m,5m"}) {
        const Answer answer = shell("cat beam.toml | hibi " + command);
        EXPECT_EQ(answer.status, 2) << command;
        EXPECT_NE(answer.out.find("/dev/stdin: error: this is a pipe or a device"), std::string::npos)
            << answer.out;
        EXPECT_NE(answer.out.find("store the scene in a file"), std::string::npos) << answer.out;
    }
    EXPECT_FALSE(is_there("out"));
}

}  // namespace
}  // namespace hibi
