#include "film/time_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hibi {
namespace {

/// Simulated seconds per second of film, just after a simulated time.
double rate_at(const TimeMap& map, double simulated) {
    const double film = map.film(simulated), step = 1e-6 * map.duration();
    return (map.simulated(film + step) - map.simulated(film)) / step;
}

TEST(TimeMap, WithoutAnythingIsEven) {
    const TimeMap map(2, 12, 5, {}, {});
    EXPECT_EQ(map.simulated(0), 2);
    EXPECT_EQ(map.simulated(2.5), 7);
    EXPECT_EQ(map.simulated(5), 12);
    EXPECT_EQ(map.film(7), 2.5);
}

TEST(TimeMap, StaysWithinItsEnds) {
    const TimeMap map(2, 12, 5, {}, Emphasis{6, 7});
    EXPECT_EQ(map.simulated(-1), 2);
    EXPECT_EQ(map.simulated(6), 12);
    EXPECT_EQ(map.simulated(std::nan("")), 2);
    EXPECT_EQ(map.film(1), 0);
    EXPECT_EQ(map.film(13), 5);
}

TEST(TimeMap, FailureFillsTwoFifthsOfTheDefaultFilm) {
    const TimeMap map(0, 40, 12, {}, Emphasis{35.3, 36.0});
    const double share = (map.film(36.0) - map.film(35.3)) / 12;
    EXPECT_GT(share, 1.0 / 3);
    EXPECT_LT(share, 0.4);  // the rest of the 40 % is the moment before first break
    EXPECT_EQ(map.simulated(12), 40);
    // What follows does not fit into a quarter of the film at the failure's rate: it gets just a quarter.
    EXPECT_NEAR(12 - map.film(36.0), 0.25 * 12, 1e-9);
}

TEST(TimeMap, WhatFollowsIsPlayedAtTheFailuresRateWhereThatFits) {
    const TimeMap map(0, 36.2, 12, {}, Emphasis{35.3, 36.0});
    EXPECT_NEAR(rate_at(map, 36.1), rate_at(map, 35.5), 1e-6);
    EXPECT_GT(rate_at(map, 10), 10 * rate_at(map, 35.5));
}

TEST(TimeMap, LongFailureIsNotSlowed) {
    const TimeMap map(0, 10, 5, {}, Emphasis{3, 8});
    EXPECT_EQ(map.knots().size(), 2u);
}

TEST(TimeMap, BodyThatBreaksInOneMomentIsSeenBreaking) {
    const TimeMap map(0, 10, 5, {}, Emphasis{4, 4});
    EXPECT_LE(map.film(3.994), 0.36 * 5);  // 0.35 before, 0.4 failure, 0.25 after
    EXPECT_GT(map.film(4.0) - map.film(3.994), 5.0 / 3);
}

TEST(TimeMap, EventsOutsideTheRunAreHarmless) {
    EXPECT_EQ(TimeMap(0, 10, 5, {}, Emphasis{20, 30}).simulated(2.5), 5);
    EXPECT_EQ(TimeMap(5, 10, 5, {}, Emphasis{1, 2}).simulated(2.5), 7.5);
    EXPECT_EQ(TimeMap(3, 3, 5, {}, Emphasis{3, 3}).simulated(2.5), 3);
    EXPECT_EQ(TimeMap(3, 3, 0, {}, {}).simulated(0), 3);
}

TEST(TimeMap, SlowSpanHasItsRateRelativeToTheRest) {
    const TimeMap map(0, 10, 12, {{4, 5, 0.05}}, Emphasis{1, 2});
    EXPECT_NEAR(rate_at(map, 4.5), 0.05 * rate_at(map, 1), 1e-6);
    EXPECT_NEAR(rate_at(map, 7), rate_at(map, 1), 1e-6);  // the emphasis counts no more
    // 9 s at rate 1 and 1 s at rate 0.05 are as long as 29 s at rate 1.
    EXPECT_NEAR(map.film(5) - map.film(4), 12 * 20.0 / 29, 1e-9);
    EXPECT_EQ(map.simulated(12), 10);
}

TEST(TimeMap, SlowerOfTwoSpansWins) {
    const TimeMap map(0, 10, 12, {{2, 6, 0.5}, {4, 8, 0.1}}, {});
    EXPECT_NEAR(rate_at(map, 3), 0.5 * rate_at(map, 1), 1e-6);
    EXPECT_NEAR(rate_at(map, 5), 0.1 * rate_at(map, 1), 1e-6);
    EXPECT_NEAR(rate_at(map, 7), 0.1 * rate_at(map, 1), 1e-6);
}

TEST(TimeMap, SlowSpanOutsideTheRunCountsNowhere) {
    EXPECT_EQ(TimeMap(0, 10, 5, {{12, 14, 0.1}}, {}).simulated(2.5), 5);
    const TimeMap map(0, 10, 5, {{-5, 1, 0.1}, {9, 20, 0.1}}, {});
    EXPECT_NEAR(rate_at(map, 0.5), 0.1 * rate_at(map, 5), 1e-6);
    EXPECT_NEAR(rate_at(map, 9.5), 0.1 * rate_at(map, 5), 1e-6);
}

// Any run, any events, any spans.
TEST(TimeMap, AlwaysRisesKeepsItsEndsAndHasAnInverse) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    int failures = 0;
    for (int k = 0; k < 2000; ++k) {
        const double begin = k % 3 ? 0 : 100 * unit(random);
        const double end = begin + (k % 17 ? 50 * unit(random) : 0);
        const double duration = 0.04 + 20 * unit(random);
        const auto moment = [&] {
            const double t = begin + (end - begin) * (1.2 * unit(random) - 0.1);
            return k % 5 ? t : std::round(t);
        };
        std::vector<SlowSpan> slow;
        for (int s = k % 4; s > 0; --s) {
            const double a = moment(), b = moment();
            slow.push_back({std::min(a, b), std::max(a, b), 0.01 + unit(random)});
        }
        const double first_break = moment(), separation = std::max(first_break, moment());
        const TimeMap map(begin, end, duration, slow, Emphasis{first_break, separation});

        EXPECT_EQ(map.duration(), duration);
        EXPECT_EQ(map.simulated(0), begin);
        EXPECT_EQ(map.simulated(duration), end);
        double last = begin;
        for (int i = 0; i <= 300; ++i) {
            const double t = map.simulated(duration * i / 300);
            ASSERT_GE(t, last);
            ASSERT_LE(t, end);
            last = t;
            ASSERT_NEAR(map.simulated(map.film(t)), t, 1e-9 * (1 + std::abs(t)));
        }
        if (slow.empty() && first_break > begin && separation < end && end > begin) {
            ++failures;
            const double lead = std::max(0.05 * (separation - first_break), 0.0005 * (end - begin));
            EXPECT_GE(map.film(separation) - map.film(first_break - lead), 0.4 * duration * (1 - 1e-9));
            if (separation - first_break > 0.0025 * (end - begin)) {  // else the lead-in is longer than it
                EXPECT_GE(map.film(separation) - map.film(first_break), duration / 3);
            }
        }
    }
    EXPECT_GT(failures, 100);
}

}  // namespace
}  // namespace hibi
