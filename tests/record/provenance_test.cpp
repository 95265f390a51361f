#include "record/provenance.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace hibi {
namespace {

const Provenance example{"A \"plate\" {bent}; 板", "0.1.0", "1f3a", "spacing=0.5 m",
                         "hibi run 'my plate.toml' -p 'spacing=0.5 m' -o out/x"};

void expect_example(const std::optional<Provenance>& found) {
    ASSERT_TRUE(found);
    EXPECT_EQ(found->title, example.title);
    EXPECT_EQ(found->version, example.version);
    EXPECT_EQ(found->scene_hash, example.scene_hash);
    EXPECT_EQ(found->parameters, example.parameters);
    EXPECT_EQ(found->command, example.command);
}

TEST(Provenance, IsTheSameBehindTextsAndBehindAComment) {
    expect_example(from_texts(to_texts(example)));
    expect_example(from_comment("# time (s), load (N); " + to_comment(example) + "\ntime,load\n{0}"));
}

TEST(Provenance, ATextWithoutACommandSaysNothing) {
    EXPECT_FALSE(from_texts({{"Software", "hibi 0.1.0"}}));
    EXPECT_FALSE(from_texts({{"Software", "other 1"}, {"Command", "rm"}}));
    EXPECT_FALSE(from_comment("time,load"));
    EXPECT_FALSE(from_comment("hibi: {broken"));
}

TEST(ShellCommand, GivesTheShellTheWordsBack) {
    const std::vector<std::string> words{"printf", "%s\\n", "plain", "", "it's", "a b", "$HOME", "板"};
    std::string shell;
    FILE* pipe = popen(shell_command(words).c_str(), "r");
    char buffer[256];
    while (const std::size_t got = fread(buffer, 1, sizeof buffer, pipe)) shell.append(buffer, got);
    pclose(pipe);
    EXPECT_EQ(shell, "plain\n\nit's\na b\n$HOME\n板\n");
    EXPECT_EQ(shell_words(shell_command(words)), words);
}

}  // namespace
}  // namespace hibi
