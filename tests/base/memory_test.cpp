#include "base/memory.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <vector>

namespace hibi {
namespace {

long page_faults() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return used.ru_minflt;
}

TEST(Memory, WhatIsFreedIsTakenAgainWithoutAskingTheSystem) {
    if (!keep_freed_memory()) GTEST_SKIP() << "memory is limited here, or a sanitizer's";
    constexpr std::size_t size = 200 << 20;  // 51 200 pages
    { const std::vector<char> first(size, 1); }
    const long before = page_faults();
    const std::vector<char> second(size, 1);
    EXPECT_LT(page_faults() - before, 500);
}

}  // namespace
}  // namespace hibi
