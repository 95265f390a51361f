#include "app/doctor.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace hibi {
namespace {

/// The findings by name, and the exit status.
std::pair<std::map<std::string, bool>, int> examined() {
    testing::internal::CaptureStdout();
    const int status = doctor_command(true);
    std::map<std::string, bool> works;
    for (const auto& finding : nlohmann::json::parse(testing::internal::GetCapturedStdout()))
        works[finding["name"]] = finding["works"];
    return {works, status};
}

TEST(Doctor, FindsWhatAFilmNeedsWhereTheTestsRun) {
    const auto [works, status] = examined();
    EXPECT_EQ(status, 0);
    for (const char* name : {"renderer osmesa", "video encoder", "fonts", "units", "output folder"})
        EXPECT_TRUE(works.at(name)) << name;
}

[[noreturn]] void examine_without_units() {
    setenv("UDUNITS2_XML_PATH", "/nonexistent", 1);
    const auto [works, status] = examined();
    std::_Exit(works.at("units") ? 2 : status);
}

TEST(Doctor, MissingUnitsAreFoundAndGiveStatusOne) {
    // In a program started afresh: UDUNITS reads its table once.
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(examine_without_units(), testing::ExitedWithCode(1), "");
}

}  // namespace
}  // namespace hibi
