#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "base/hash.hpp"
#include "scene/everything.hpp"
#include "scene/read.hpp"

namespace hibi {
namespace {

/// One damaged copy of a text: a few bytes changed, cut out, doubled, or replaced by what is hard to read.
std::string damaged(std::string text, std::uint64_t seed) {
    static const std::vector<std::string> hard{"[",
                                               "]",
                                               "{",
                                               "}",
                                               "\"",
                                               "'",
                                               "\"\"\"",
                                               "=",
                                               ".",
                                               "#",
                                               "\n",
                                               "\\",
                                               "\\u0000",
                                               "inf",
                                               "nan",
                                               "1e400",
                                               "-1",
                                               "0",
                                               "(",
                                               ")",
                                               "^",
                                               "^-9",
                                               "1e308",
                                               "1e-308",
                                               "[[body]]",
                                               "[run]",
                                               "x",
                                               " m",
                                               "9223372036854775807",
                                               std::string(1, '\0'),
                                               "\xff",
                                               "割",
                                               "1979-05-27",
                                               "true",
                                               "[]",
                                               "{}",
                                               "\"\""};
    std::uint64_t state = mix_bits(seed);
    const auto random = [&](std::size_t below) {
        state = mix_bits(state);
        return static_cast<std::size_t>(state % std::max<std::size_t>(1, below));
    };
    for (std::size_t times = 1 + random(3); times > 0; --times) {
        const std::size_t at = random(text.size()), length = random(12);
        switch (random(4)) {
            case 0:
                text.erase(at, length);
                break;
            case 1:
                text.insert(at, hard[random(hard.size())]);
                break;
            case 2:
                text.replace(at, length, hard[random(hard.size())]);
                break;
            default:
                text.insert(random(text.size()), text.substr(at, 8 * length));
        }
    }
    return text;
}

/// Answers without a crash; a scene that is right also writes and reads back.
bool survives(const std::string& text) {
    try {
        const std::string written = write_scene(parse_scene(text, "s.toml"));
        EXPECT_EQ(write_scene(parse_scene(written, "again")), written);
        return true;
    } catch (const SceneErrors& errors) {
        EXPECT_FALSE(errors.errors().empty());
        for (const SceneError& error : errors.errors()) EXPECT_FALSE(error.message.empty());
        return false;
    }
}

TEST(Robustness, DamagedScenesAreAnswered) {
    int right = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
        SCOPED_TRACE(seed);
        right += survives(damaged(small_scene, seed));
        if (seed % 8 == 0) survives(damaged(everything, seed));
    }
    EXPECT_GT(right, 40);    // some damage is harmless
    EXPECT_LT(right, 2000);  // most is not
}

}  // namespace
}  // namespace hibi
