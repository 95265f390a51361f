// Where words find room: free places in an area, and flags at the upper ends of lines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/flags.hpp"
#include "image/free_places.hpp"

namespace hibi {
namespace {

TEST(FreePlaces, BesideAPointWhereNothingElseIs) {
    const FreePlaces free({0, 0, 100, 100}, 1);
    const auto box = free.nearest({50, 50}, 20, 8, 3);
    ASSERT_TRUE(box);
    EXPECT_EQ(box->x, 53);
    EXPECT_EQ(box->y, 46);
}

TEST(FreePlaces, NeitherOnALineNorOnABoxNorOutside) {
    FreePlaces free({0, 0, 100, 100}, 1);
    free.take(Polyline{{0, 100}, {90, 90}, {90, 0}});
    for (int k = 0; k < 8; ++k) {
        const auto box = free.nearest({90, 90}, 30, 8, 3);
        ASSERT_TRUE(box) << k;
        EXPECT_FALSE(cut({0, 100}, {90, 90}, *box));
        EXPECT_LT(box->x + box->width, 90);
        EXPECT_GE(box->y, 0);
        free.take(*box);
    }
}

TEST(FreePlaces, NoneWhereAllIsTaken) {
    FreePlaces free({0, 0, 100, 100}, 1);
    for (int k = 0; k < 20; ++k) free.take(Polyline{{0, 5.0 * k}, {100, 5.0 * k}});
    EXPECT_FALSE(free.nearest({50, 50}, 20, 8, 3));
}

TEST(FreePlaces, TheWayThereDoesNotRunThroughAnotherLabel) {
    FreePlaces free({0, 0, 100, 100}, 1);
    // A tunnel too low for the label; it would be nearer above or below, but only the end is open.
    free.take(PixelRect{30, 43, 45, 5});
    free.take(PixelRect{30, 56, 45, 5});
    free.take(PixelRect{30, 43, 5, 18});
    const auto box = free.nearest({50, 52}, 15, 8, 3);
    ASSERT_TRUE(box);
    EXPECT_GT(box->x, 75);
}

TEST(Flags, WordsTouchNoOtherWordsAndNoLineRunsThroughThem) {
    unsigned random = 7;
    const auto next = [&](double most) {
        random = random * 1664525u + 1013904223u;
        return most * (random >> 8) / 16777216.0;
    };
    int placed = 0;
    for (int tries = 0; tries < 300; ++tries) {
        std::vector<Flag> flags;
        for (int k = 0; k < 4; ++k) flags.push_back({.x = 10 + next(180), .width = 15 + next(60)});
        if (!place_flags(flags, 0, 200, 2)) continue;
        ++placed;
        for (const Flag& a : flags) {
            EXPECT_GE(a.begin(), 0);
            EXPECT_LE(a.end(), 200);
            for (const Flag& b : flags) {
                if (&a == &b) continue;
                const bool touch = a.begin() < b.end() && b.begin() < a.end();
                EXPECT_FALSE(touch && a.row == b.row);
                EXPECT_FALSE(a.row <= b.row && b.x > a.begin() && b.x < a.end());
            }
        }
    }
    EXPECT_GT(placed, 250);
}

TEST(Flags, ThoseAtTheEdgesPointInwards) {
    std::vector<Flag> flags{{.x = 5, .width = 50}, {.x = 195, .width = 50}};
    ASSERT_TRUE(place_flags(flags, 0, 200, 2));
    EXPECT_FALSE(flags[0].to_left);
    EXPECT_TRUE(flags[1].to_left);
    EXPECT_EQ(flags[0].row, 0);
    EXPECT_EQ(flags[1].row, 0);
}

}  // namespace
}  // namespace hibi
