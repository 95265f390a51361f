// What the program brings for editors and shells, as they use it.
#include <gtest/gtest.h>

#include "support/call.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

TEST(WebNew, ScenesNameTheSchemaOfTheProgramAndAreAcceptedByIt) {
    const TemporaryFolder folder;
    const std::string in_folder = "cd " + folder.path().string() + " && ";
    ASSERT_EQ(
        call(in_folder + HIBI_PROGRAM " new starter && " HIBI_PROGRAM " new copy --from bending_fine").status,
        0);
    const std::string lint = HIBI_WEB "/node_modules/.bin/taplo lint --no-auto-config ";
    Answer answer = call(in_folder + lint + "starter.toml copy.toml");
    EXPECT_EQ(answer.status, 0) << answer.out;
    ASSERT_EQ(call(in_folder + "sed -i 's/^ramp .*/ramp = true/' starter.toml copy.toml").status, 0);
    answer = call(in_folder + lint + "starter.toml copy.toml");
    for (const char* name : {"starter.toml", "copy.toml"})
        EXPECT_NE(answer.out.find("schema validation failed path=\"" + (folder.path() / name).string()),
                  std::string::npos)
            << answer.out;
}

/// What bash offers for these words, the last of which is being typed, one blank between two.
std::string offered_by_bash(const std::string& words) {
    const Answer answer = call("bash -c 'source <(" HIBI_PROGRAM " completion bash); COMP_WORDS=(" + words +
                               "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _hibi; echo \"${COMPREPLY[*]}\"'");
    EXPECT_EQ(answer.status, 0) << answer.out;
    return answer.out.substr(0, answer.out.size() - 1);
}

TEST(Completion, BashOffersCommandsOptionsAndChoices) {
    EXPECT_EQ(offered_by_bash("hibi ren"), "render");
    EXPECT_EQ(offered_by_bash("hibi --vers"), "--version");
    EXPECT_EQ(offered_by_bash("hibi run --thr"), "--threads");
    EXPECT_EQ(offered_by_bash("hibi run scene.toml --gl \"\""), "osmesa egl");
    EXPECT_EQ(offered_by_bash("hibi run --gl = e"), "egl");
    EXPECT_EQ(offered_by_bash("hibi completion \"\""), "bash zsh fish");
    // Nothing of its own for a file: bash completes it.
    EXPECT_EQ(offered_by_bash("hibi run \"\""), "");
    EXPECT_EQ(offered_by_bash("hibi run -o \"\""), "");
    EXPECT_NE(call(HIBI_PROGRAM " completion bash").out.find("complete -o default -F _hibi hibi\n"),
              std::string::npos);
}

TEST(Completion, FishOffersCommandsOptionsChoicesAndFiles) {
    const TemporaryFolder folder;
    const auto offered = [&](const std::string& line) {
        const Answer answer = call("cd " + folder.path().string() +
                                   " && touch my.toml && HOME=$PWD fish --no-config -c '" HIBI_PROGRAM
                                   " completion fish | source; complete -C \"" +
                                   line + "\"' | cut -f 1 | paste -sd ' '");
        EXPECT_EQ(answer.status, 0);
        return answer.out;
    };
    EXPECT_EQ(offered("hibi ren"), "render\n");
    EXPECT_EQ(offered("hibi run --thr"), "--threads\n");
    EXPECT_EQ(offered("hibi run my.toml --gl "), "egl osmesa\n");
    EXPECT_EQ(offered("hibi completion "), "bash fish zsh\n");
    EXPECT_EQ(offered("hibi run m"), "my.toml\n");
    EXPECT_EQ(offered("hibi doctor m"), "\n");
}

TEST(Completion, ZshReadsItsScript) {
    const Answer answer = call("bash -c 'zsh -n <(" HIBI_PROGRAM " completion zsh)'");
    EXPECT_EQ(answer.status, 0);
    EXPECT_EQ(answer.out, "");
}

TEST(Completion, AnotherShellIsRefused) { EXPECT_EQ(call(HIBI_PROGRAM " completion tcsh").status, 2); }

TEST(Profile, OfARunStandsInItsSummaryWhereAskedFor) {
    const TemporaryFolder folder;
    const std::string run = "cd " + folder.path().string() +
                            " && " HIBI_PROGRAM " run " HIBI_SOURCE_DIR
                            "/scenes/ci/beam.toml -q --no-pictures -o run";
    const auto summary = [&] { return call("cat " + (folder.path() / "run/run.json").string()).out; };
    ASSERT_EQ(call(run).status, 0);
    EXPECT_EQ(summary().find("\"profile\""), std::string::npos);
    const Answer answer = call(run + " --profile");
    ASSERT_EQ(answer.status, 0);
    EXPECT_NE(answer.out.find("ms per call"), std::string::npos) << answer.out;
    for (const char* stage : {"setup", "bond forces (moment-matched), watch limits, half kick", "take states",
                              "history", "write states"}) {
        EXPECT_NE(answer.out.find(stage), std::string::npos) << answer.out;
        EXPECT_NE(summary().find("\"stage\": \"" + std::string(stage) + "\""), std::string::npos);
    }
}

TEST(Manual, IsSetWithoutWarningsAndHoldsEveryCommand) {
    const Answer page =
        call("bash -o pipefail -c '" HIBI_PROGRAM " manual | groff -man -ww -Tascii -P-c -P-b -P-u'");
    EXPECT_EQ(page.status, 0);
    EXPECT_EQ(page.out.find("warning"), std::string::npos) << page.out;
    for (const char* part :
         {"hibi run SCENE", "hibi new [NAME]", "--gl osmesa|egl", "3 pictures or", "hibi check scene.toml"})
        EXPECT_NE(page.out.find(part), std::string::npos) << part << page.out;
}

TEST(WebPackage, DebianPackageWorksWhereverItIsUnpacked) {
    const TemporaryFolder folder;
    const std::string in_folder = "cd " + folder.path().string() + " && ";
    Answer answer = call(in_folder + "cpack --config " HIBI_BUILD_DIR
                                     "/CPackConfig.cmake -B . && dpkg-deb -x *.deb root");
    ASSERT_EQ(answer.status, 0) << answer.out;
    answer = call(in_folder + "dpkg-deb -f *.deb Depends Recommends");
    for (const char* needed : {"libosmesa6", "libudunits2-0", "libavcodec", "libegl1"})
        EXPECT_NE(answer.out.find(needed), std::string::npos) << needed << answer.out;
    for (const char* file :
         {"bin/hibi", "share/hibi/scene.schema.json", "share/hibi/scenes/bending_fine.toml",
          "share/hibi/scenes/verify/bar.toml", "share/man/man1/hibi.1.gz",
          "share/bash-completion/completions/hibi", "share/zsh/vendor-completions/_hibi",
          "share/fish/vendor_completions.d/hibi.fish", "share/doc/hibi/README.md",
          "share/doc/hibi/REFERENCE.md", "share/doc/hibi/copyright"})
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "root/usr" / file)) << file;

    ASSERT_EQ(call(in_folder + "root/usr/bin/hibi new mine").status, 0);
    answer = call(in_folder + "head -n 1 mine.toml");
    EXPECT_EQ(answer.out,
              "#:schema file://" + (folder.path() / "root/usr/share/hibi/scene.schema.json").string() + "\n");
    // Their own first lines lead to the schema.
    const std::string scene =
        "root/usr/share/hibi/scenes/bending_fine.toml root/usr/share/hibi/scenes/verify/bar.toml ";
    answer = call(in_folder + HIBI_WEB "/node_modules/.bin/taplo lint --no-auto-config mine.toml " + scene);
    EXPECT_EQ(answer.status, 0) << answer.out;
    answer = call(in_folder + "sed -i 's/^ramp .*/ramp = true/' " + scene +
                  "&& " HIBI_WEB "/node_modules/.bin/taplo lint --no-auto-config " + scene);
    EXPECT_NE(answer.out.find("true is not of types"), std::string::npos) << answer.out;
}

}  // namespace
}  // namespace hibi
