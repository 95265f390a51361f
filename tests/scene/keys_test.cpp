#include "scene/keys.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <regex>

#include "scene/everything.hpp"
#include "scene/read.hpp"

namespace hibi {
namespace {

/// A key and its value as they are set.
std::regex setting(const std::string& key) { return std::regex("\\b" + key + " = (\"[^\"]*\"|[-.\\w]+)"); }

/// What is said of a scene that uses everything, with `value` for `key` wherever it stands.
std::string answer_with(const std::string& key, double value) {
    try {
        // Nothing is built where a value is out of its range, so this takes no time.
        parse_scene(
            std::regex_replace(std::string(everything), setting(key), key + fmt::format(" = {}", value)),
            "s.toml");
    } catch (const SceneErrors& errors) {
        return errors.what();
    }
    return "";
}

TEST(Keys, RefuseWhatLiesBeyondTheirRange) {
    int ends = 0;
    for (const KeyBlock& block : scene_blocks())
        for (const Key& key : block.keys) {
            if (!std::regex_search(everything, setting(key.name))) continue;
            const std::string expected = " " + key.name + " needs to be " + key.range.words() + "; found ";
            if (key.range.is_limited_below()) {
                EXPECT_NE(answer_with(key.name, key.range.low.value - 1).find(expected), std::string::npos)
                    << block.title << expected;
                ++ends;
            }
            if (key.range.is_limited_above()) {
                EXPECT_NE(answer_with(key.name, key.range.high.value + 1).find(expected), std::string::npos)
                    << block.title << expected;
                ++ends;
            }
        }
    EXPECT_GE(ends, 30);
}

TEST(Range, HoldsItsEndsWhereItSaysSo) {
    Key open, closed;
    above(0)(open), below(1, "too much")(open);
    at_least(0)(closed), at_most(1)(closed);
    EXPECT_EQ(open.range.words(), "above 0 and below 1");
    EXPECT_EQ(closed.range.words(), "from 0 to 1");
    EXPECT_TRUE(open.range.passed_by(0));
    EXPECT_FALSE(open.range.passed_by(0.5));
    ASSERT_TRUE(open.range.passed_by(1));
    EXPECT_EQ(open.range.passed_by(1)->hint, "too much");
    EXPECT_FALSE(closed.range.passed_by(0) || closed.range.passed_by(1));
    EXPECT_TRUE(closed.range.passed_by(1.001));
    EXPECT_EQ(Key{}.range.words(), "");
    EXPECT_FALSE(Key{}.range.passed_by(-1e300));
}

TEST(Keys, StateTheDefaultOfTheirMember) {
    const auto standard = [](const char* block, const char* key) {
        return scene_block(block).find(key)->standard;
    };
    EXPECT_EQ(standard("model", "thickness"), "1 m");
    EXPECT_EQ(standard("model", "assumption"), "plane stress");
    EXPECT_EQ(standard("gravity", "acceleration"), "[0, -9.80665]");
    EXPECT_EQ(standard("body", "spin"), "0");  // "0 1/s" would not be a quantity
    EXPECT_EQ(standard("movie", "formats"), "[\"mp4\"]");
    EXPECT_EQ(standard("material", "break_strain"), "");
}

}  // namespace
}  // namespace hibi
