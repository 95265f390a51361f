#include "image/axis.hpp"

#include <gtest/gtest.h>

namespace hibi {
namespace {

using Numbers = std::vector<double>;

TEST(Scale, PrefixSuitsTheLargestValue) {
    EXPECT_EQ(scale_for(3.6e7, "N").unit, "MN");
    EXPECT_DOUBLE_EQ(scale_for(3.6e7, "N").factor, 1e-6);
    EXPECT_EQ(scale_for(1000, "Pa").unit, "kPa");
    EXPECT_EQ(scale_for(999, "Pa").unit, "Pa");
    EXPECT_EQ(scale_for(1e6 * (1 - 1e-12), "N").unit, "MN");  // a million but for rounding
    EXPECT_EQ(scale_for(-2e-4, "m").unit, "µm");
    EXPECT_EQ(scale_for(7200, "s").unit, "s");
    EXPECT_EQ(scale_for(0, "N").unit, "N");
}

TEST(Scale, PlainNumbersBecomePercentOrAPowerOfTen) {
    EXPECT_EQ(scale_for(0.1, "").unit, "%");
    EXPECT_EQ(scale_for(1, "").unit, "");
    EXPECT_EQ(scale_for(2e-6, "").unit, "×10⁻⁶");
    EXPECT_DOUBLE_EQ(scale_for(2e-6, "").factor, 1e6);
}

TEST(Decimal, HasATrueMinusAndNoNegativeZero) {
    EXPECT_EQ(decimal(-1.25, 1), "−1.2");
    EXPECT_EQ(decimal(-0.001, 2), "0.00");
    EXPECT_EQ(decimal(17.654, 3), "17.654");
}

TEST(Ticks, ALoneOneIsNoScale) {
    EXPECT_EQ(round_ticks(0, 416, 2).at, (Numbers{0, 250}));  // 200 would give three, 500 one
}

TEST(Ticks, AreRoundAndFewEnough) {
    EXPECT_EQ(round_ticks(0, 37, 5).at, (Numbers{0, 10, 20, 30}));
    EXPECT_EQ(round_ticks(0, 1.7, 5).at, (Numbers{0, 0.5, 1.0, 1.5}));
    EXPECT_EQ(round_ticks(0, 1.7, 5).decimals, 1);
    for (double high = 0.013; high < 1e6; high *= 1.37)
        for (const int most : {2, 3, 5, 9}) {
            const Ticks ticks = round_ticks(0, high, most);
            EXPECT_LE(static_cast<int>(ticks.at.size()), most) << high;
            EXPECT_GE(ticks.at.size(), most > 2 ? 2u : 1u) << high;
        }
}

TEST(Ticks, ReachBothEndsOfARoundRange) {
    EXPECT_EQ(round_ticks(-8, 8, 7).at, (Numbers{-8, -4, 0, 4, 8}));
    EXPECT_EQ(round_ticks(-10, 10, 3).at, (Numbers{-10, 0, 10}));
    EXPECT_EQ(round_ticks(0, 2.5, 3).at, (Numbers{0, 2.5}));
    EXPECT_EQ(round_ticks(0, 2.5, 3).decimals, 1);
}

TEST(Ticks, OfALogarithmicAxisArePowersOfTenWithTwoAndFiveWhereThereIsRoom) {
    EXPECT_EQ(log_ticks(0.9, 110, 9), (Numbers{1, 2, 5, 10, 20, 50, 100}));
    EXPECT_EQ(log_ticks(0.9, 110, 6), (Numbers{1, 10, 100}));
    EXPECT_EQ(log_ticks(0.5, 2e6, 4), (Numbers{1, 100, 10'000, 1'000'000}));
    EXPECT_EQ(log_ticks(3.1, 4.6, 5), (Numbers{3.5, 4, 4.5}));
    Numbers minor;
    log_ticks(0.9, 31, 3, &minor);
    EXPECT_EQ(minor, (Numbers{0.9, 2, 3, 4, 5, 6, 7, 8, 9, 20, 30}));
}

TEST(RoundBelow, IsTheLargestRoundNumberThatFits) {
    EXPECT_DOUBLE_EQ(round_below(9.9), 5);
    EXPECT_DOUBLE_EQ(round_below(5), 5);
    EXPECT_DOUBLE_EQ(round_below(0.0013), 0.001);
    EXPECT_DOUBLE_EQ(round_below(1000), 1000);
}

}  // namespace
}  // namespace hibi
