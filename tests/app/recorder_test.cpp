#include "app/recorder.hpp"

#include <gtest/gtest.h>

#include <set>

namespace hibi {
namespace {

TEST(EvenStates, AreEvenAndBoundedHoweverLongTheRun) {
    for (const int steps : {50, 1000, 12345, 100000}) {
        EvenStates states(0, 4.0, 20);
        std::set<std::int64_t> kept;
        for (int step = 0; step <= steps; ++step) {
            if (!states.due(step)) continue;
            kept.insert(step);
            for (const std::int64_t dropped : states.keep(step, step)) EXPECT_EQ(kept.erase(dropped), 1u);
            EXPECT_LE(kept.size(), 20u);
        }
        EXPECT_GE(kept.size(), std::min<std::size_t>(10, steps / 4));
        EXPECT_EQ(*kept.begin(), 0);
        EXPECT_GT(*kept.rbegin(), steps - 2 * states.interval());
        std::int64_t last = -1;
        for (const std::int64_t step : kept) {
            if (last >= 0) {
                EXPECT_EQ(step - last, static_cast<std::int64_t>(states.interval())) << steps;
            }
            last = step;
        }
    }
}

TEST(EvenStates, GoOnWhereTheIntervalIsLostInTheDigitsOfTheTime) {
    EvenStates states(1, 1e-19, 20);
    ASSERT_TRUE(states.due(1));
    states.keep(1, 1);  // came to no end when it added intervals up
    EXPECT_FALSE(states.due(1));
    EXPECT_TRUE(states.due(1.001));
}

}  // namespace
}  // namespace hibi
