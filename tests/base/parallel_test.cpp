#include "base/parallel.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <vector>

namespace hibi {
namespace {

class Parallel : public ::testing::TestWithParam<int> {
 protected:
    Parallel() { set_threads(GetParam()); }
    ~Parallel() override { set_threads(0); }
};

TEST_P(Parallel, EveryIndexIsVisitedOnce) {
    for (const int n : {0, 1, parallel_block, parallel_block + 1, 10 * parallel_block - 1}) {
        std::vector<std::atomic<int>> visits(n);
        parallel_for(n, [&](int begin, int end) {
            for (int i = begin; i < end; ++i) ++visits[i];
        });
        for (int i = 0; i < n; ++i) ASSERT_EQ(visits[i], 1) << i << " of " << n;
    }
}

TEST_P(Parallel, SumHasTheBitsOfOneThread) {
    constexpr int n = 10 * parallel_block + 7;
    // Terms of very different size: another order of adding gives other bits.
    const auto part = [](int begin, int end) {
        double sum = 0;
        for (int i = begin; i < end; ++i) sum += std::sin(i) * std::exp(i % 40);
        return sum;
    };
    double expected = 0;
    for (int begin = 0; begin < n; begin += parallel_block)
        expected += part(begin, std::min(n, begin + parallel_block));
    EXPECT_EQ(parallel_sum<double>(n, part), expected);
}

TEST_P(Parallel, SumOfNothingIsZero) {
    EXPECT_EQ(parallel_sum<double>(0, [](int, int) { return 1.0; }), 0);
}

INSTANTIATE_TEST_SUITE_P(Threads, Parallel, ::testing::Values(1, 2, 3, 8));

TEST(Threads, AreAsManyAsSetAndZeroMeansWhatTheMachineHas) {
    const int of_machine = threads();
    EXPECT_GE(of_machine, 1);
    for (const int count : {3, 5}) {
        set_threads(count);
        EXPECT_EQ(threads(), count);
    }
    set_threads(0);
    EXPECT_EQ(threads(), of_machine);
}

}  // namespace
}  // namespace hibi
