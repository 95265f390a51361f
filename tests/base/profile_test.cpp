#include "base/profile.hpp"

#include <gtest/gtest.h>

namespace hibi {
namespace {

TEST(Profile, TableGivesShareOfTheWallAndTimePerCall) {
    const std::string table = profile_table("draw", {{"read back", 0.5, 100}, {"hash", 2, 1}}, 2);
    EXPECT_EQ(table,
              "draw         seconds of wall     calls ms per call\n"
              "read back      0.500  25.0 %       100       5.000\n"
              "hash           2.000 100.0 %         1    2000.000\n");
}

TEST(Profile, ProcessorTimePasses) {
    const double before = processor_seconds();
    volatile double sum = 0;
    for (int i = 0; i < 20'000'000; ++i) sum = sum + 1;
    EXPECT_GT(processor_seconds(), before);
}

}  // namespace
}  // namespace hibi
