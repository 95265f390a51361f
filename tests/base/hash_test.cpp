#include "base/hash.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hibi {
namespace {

TEST(Hash, Sha256OfTheStandardsExamples) {
    // FIPS 180-4, examples of one and of two blocks, and the empty message.
    EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Hash, MixedBitsAreThoseOfSplitMix64) {
    // First outputs of the published generator with seed 0 (Vigna's splitmix64.c): its state grows by the
    // golden ratio constant, which mix_bits adds itself.
    EXPECT_EQ(mix_bits(0), 0xe220a8397b1dcdafu);
    EXPECT_EQ(mix_bits(0x9e3779b97f4a7c15u), 0x6e789e6aa1b965f4u);
    EXPECT_EQ(mix_bits(2 * 0x9e3779b97f4a7c15u), 0x06c45d188009454fu);
}

TEST(Hash, RandomNumbersLieStrictlyBetweenZeroAndOne) {
    EXPECT_GT(unit_random(0), 0);
    EXPECT_LT(unit_random(std::numeric_limits<std::uint64_t>::max()), 1);
    // -ln U must be finite and above 0 for both, or a bond would have no strength, or an infinite one.
    EXPECT_TRUE(std::isfinite(std::log(unit_random(0))));
    EXPECT_LT(std::log(unit_random(std::numeric_limits<std::uint64_t>::max())), 0);
}

TEST(Hash, RandomNumbersFromACounterAreUniform) {
    constexpr int count = 100'000;
    double sum = 0, squares = 0;
    for (int i = 0; i < count; ++i) {
        const double u = unit_random(mix_bits(i));
        sum += u;
        squares += u * u;
    }
    // Mean 1/2 and mean square 1/3; five standard errors, sqrt(1/12/count) and sqrt(4/45/count).
    EXPECT_NEAR(sum / count, 1.0 / 2, 5 * std::sqrt(1.0 / 12 / count));
    EXPECT_NEAR(squares / count, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / count));
}

}  // namespace
}  // namespace hibi
