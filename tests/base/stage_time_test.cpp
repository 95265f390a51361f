#include "base/stage_time.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace hibi {
namespace {

TEST(StageTimes, CallsOfAStageAddUpInTheOrderOfTheList) {
    StageTimes times({"first", "never", "second"});
    times.add("second", 1);
    times.add("unforeseen", 5);
    times.add("first", 0.5);
    times.add("second", 2);
    const std::vector<StageTime> list = times.list();
    ASSERT_EQ(list.size(), 3u);
    EXPECT_EQ(list[0].name, "first");
    EXPECT_EQ(list[1].name, "second");
    EXPECT_EQ(list[1].seconds, 3);
    EXPECT_EQ(list[1].calls, 2);
    EXPECT_EQ(list[2].name, "unforeseen");
}

TEST(StageTimes, AStageLastsUntilTheEndOfItsScope) {
    StageTimes times({"sleep"});
    {
        const TimedStage timed(&times, "sleep");
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        EXPECT_TRUE(times.list().empty());
    }
    ASSERT_EQ(times.list().size(), 1u);
    EXPECT_GE(times.list()[0].seconds, 0.02);
    { const TimedStage nobody_asked(nullptr, "sleep"); }
    EXPECT_EQ(times.list()[0].calls, 1);
}

}  // namespace
}  // namespace hibi
