// `hibi verify` as a user calls it.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "support/call.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Answer verify(const std::string& arguments) { return call(HIBI_PROGRAM " verify " + arguments); }

TEST(VerifyCommand, ListsItsCasesAndRefusesOthers) {
    const Answer list = verify("--list");
    EXPECT_EQ(list.status, 0);
    for (const char* name : {"bar ", "cantilever ", "elastica ", "cracked_strip "})
        EXPECT_NE(list.out.find(name), std::string::npos) << name << list.out;
    const Answer wrong = verify("--case cantilevr");
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.out.find("did you mean \"cantilever\""), std::string::npos) << wrong.out;
    EXPECT_NE(call(HIBI_PROGRAM " new --list").out.find("\nverify/bar "), std::string::npos);
}

TEST(VerifyCommand, ExitStatusTellsAMissedGoal) {
    const TemporaryFolder folder;
    const std::string command = "--case bar --quick -q --json -o " + folder.path().string();
    const Answer good = verify(command);
    EXPECT_EQ(good.status, 0) << good.out;
    const Json rows = Json::parse(good.out);
    ASSERT_EQ(rows.size(), 4u);
    for (const char* key : {"case", "variant", "particles", "resolution", "error", "goal", "seconds", "pass"})
        EXPECT_TRUE(rows[0].contains(key)) << key;
    const Answer missed = verify(command + " --goals 1e-9");
    EXPECT_EQ(missed.status, 1) << missed.out;
    EXPECT_EQ(Json::parse(missed.out)[0]["pass"], false);
}

TEST(WebVerify, PageOpensOnAnyScreenAndAsksNothingOfANetwork) {
    const TemporaryFolder folder;
    ASSERT_EQ(verify("--case bar --case bar_wave --quick -q -o " + folder.path().string()).status, 0);
    const Answer answer =
        call("node " HIBI_WEB "/page_check.mjs " + (folder.path() / "verify.html").string());
    EXPECT_EQ(answer.status, 0) << answer.out;
}

TEST(SlowVerify, AllQuickGoalsAreReachedWithinAMinuteOfTwoCores) {
    const TemporaryFolder folder;
    const Answer answer = verify("--quick -q --json -o " + folder.path().string());
    EXPECT_EQ(answer.status, 0) << answer.out;
    double seconds = 0;
    for (const Json& row : Json::parse(answer.out)) seconds += row["cpu_seconds"].get<double>();
    EXPECT_LT(seconds, 60);
}

}  // namespace
}  // namespace hibi
