#include "app/command_text.hpp"

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>

#include "app/command_line.hpp"
#include "app/completion.hpp"
#include "app/manual.hpp"

namespace hibi {
namespace {

/// A program with one of everything, and help that is hard to quote.
struct Small {
    CLI::App app{"small makes", "small"};
    std::string text, kind, file;
    int count = 0;
    bool flag = false;
    Small() {
        app.set_help_all_flag("--help-all", "all");
        app.footer("Examples:\n  small go x   it's 'quoted' \\ [so]\n\nExit status: 0 done.\n");
        CLI::App* go = app.add_subcommand("go", "Goes: it's 'quoted' \\ [so]");
        go->add_option("FILE", file, "what to go to")->required();
        go->add_option("-k,--kind", kind, "it's 'quoted' \\ [so]")->check(CLI::IsMember({"one", "two"}));
        go->add_option("--count", count, "how often")->check(CLI::Range(1, 9));
        go->add_flag("!--no-flag", flag, "not so");
    }
};

TEST(CommandText, SaysWhatEachOptionTakes) {
    const Small small;
    const auto commands = describe_commands(small.app);
    ASSERT_EQ(commands.size(), 1u);
    ASSERT_EQ(commands[0].arguments.size(), 1u);
    EXPECT_TRUE(commands[0].arguments[0].required);
    EXPECT_TRUE(commands[0].arguments[0].takes_file());
    const auto& options = commands[0].options;
    ASSERT_EQ(options.size(), 4u);  // with -h; --help-all belongs to the program
    EXPECT_EQ(options[1].names, (std::vector<std::string>{"-k", "--kind"}));
    EXPECT_EQ(options[1].choices, (std::vector<std::string>{"one", "two"}));
    EXPECT_FALSE(options[1].takes_file());
    EXPECT_EQ(options[2].value, "INT");
    EXPECT_EQ(options[2].choices, std::vector<std::string>{});
    EXPECT_EQ(options[3].names, std::vector<std::string>{"--no-flag"});
    EXPECT_EQ(options[3].value, "");
}

TEST(CommandText, IsQuotedForEveryShellAndForRoff) {
    const Small small;
    EXPECT_NE(completion_script(small.app, "zsh")
                  .find(R"('*--kind=[it'\''s '\''quoted'\'' \\ [so\]]:TEXT:(one two)')"),
              std::string::npos);
    EXPECT_NE(completion_script(small.app, "fish")
                  .find(R"(-s k -l kind -x -a 'one two' -d 'it\'s \'quoted\' \\ [so]')"),
              std::string::npos);
    EXPECT_NE(manual_page(small.app).find(R"(it's 'quoted' \e [so])"), std::string::npos);
    EXPECT_THROW(completion_script(small.app, "tcsh"), std::out_of_range);
}

TEST(CommandText, OfTheProgramIsInEveryScriptAndInTheManual) {
    int status = 0;
    const auto app = make_command_line(status);
    std::string manual = manual_page(*app);
    for (std::size_t at = 0; (at = manual.find("\\-", at)) != manual.npos;) manual.erase(at, 1);
    for (const CommandText& command : describe_commands(*app)) {
        EXPECT_NE(manual.find("hibi " + command.name), std::string::npos);
        EXPECT_NE(command.help, "");
        for (const std::string& shell : completion_shells())
            EXPECT_NE(completion_script(*app, shell).find(command.name), std::string::npos);
        for (const ArgumentText& option : command.options) {
            const std::string name = option.names.back(), label = command.name + " " + name;
            EXPECT_NE(option.help, "") << label;
            EXPECT_NE(completion_script(*app, "bash").find(name), std::string::npos) << label;
            EXPECT_NE(completion_script(*app, "zsh").find("'*" + name), std::string::npos) << label;
            if (name.starts_with("--"))
                EXPECT_NE(completion_script(*app, "fish").find(" -l " + name.substr(2)), std::string::npos)
                    << label;
            if (name != "--help") EXPECT_NE(manual.find(name), std::string::npos) << label;
        }
    }
}

}  // namespace
}  // namespace hibi
