#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>

#include "scene/everything.hpp"
#include "scene/keys.hpp"
#include "scene/read.hpp"

namespace hibi {
namespace {

std::string reference() {
    std::ostringstream text;
    text << std::ifstream(HIBI_SOURCE_DIR "/scenes/REFERENCE.md").rdbuf();
    return text.str();
}

/// The part of the reference under a block's heading.
std::string section(const KeyBlock& block) {
    const std::string heading = block.name.empty() ? "### Top of the file"
                                : block.form == KeyBlock::Form::inner
                                    ? "### `" + block.title + "` inside a block"
                                    : "### `" + block.title + "`";
    const std::string all = reference();
    const std::size_t at = all.find(heading + "\n");
    return at == std::string::npos ? "" : all.substr(at, all.find("\n##", at + 1) - at);
}

std::string in_code(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "`" : ", `") + name + "`";
    return text;
}

/// A key's unit or kind in words.
std::string kind_of(const Key& key) {
    switch (key.kind) {
        case KeyKind::text:
            return "text";
        case KeyKind::flag:
            return "true or false";
        case KeyKind::integer:
            return "whole number";
        case KeyKind::choice:
            return "one of " + in_code(key.choices);
        case KeyKind::choices:
            return "list of " + in_code(key.choices);
        case KeyKind::names:
            return "list of names";
        case KeyKind::quantity:
            return key.unit.empty() ? "number" : key.unit;
        case KeyKind::vector:
            return "[" + key.unit + ", " + key.unit + "]";
        case KeyKind::point:
            return "point, " + key.unit;
        case KeyKind::points:
            return "points, " + key.unit;
        case KeyKind::moment:
            return "moment";
        case KeyKind::moments:
            return "list of moments";
        case KeyKind::condition:
            return "selection";
        case KeyKind::range:
            return "range";
        case KeyKind::size:
            return "[pixels, pixels]";
        case KeyKind::table:
            return "table `" + scene_block(key.unit).title + "`";
        case KeyKind::tables:
            return "list of tables `" + scene_block(key.unit).title + "`";
    }
    return "";
}

/// What the second column says of a key, with the values that are allowed.
std::string kind_and_range(const Key& key) {
    const std::string range = key.range.words();
    return kind_of(key) + (range.empty() ? "" : ", " + range) + (key.varies ? "; may vary" : "");
}

/// The table of a block's keys as it has to stand in the reference.
std::string table_of(const KeyBlock& block) {
    std::string text = "| key | unit or kind | default | meaning | example |\n|---|---|---|---|---|\n";
    for (const Key& key : block.keys)
        if (key.available)
            text += "| `" + key.name + "` | " + kind_and_range(key) + " | " +
                    (key.standard.empty() ? "absent" : key.standard) + " | " + key.meaning + " | `" +
                    key.example + "` |\n";
    return text;
}

TEST(Reference, HoldsTheTableOfEveryBlock) {
    for (const KeyBlock& block : scene_blocks()) {
        if (!block.available) {
            EXPECT_NE(reference().find("`" + block.title + "`"), std::string::npos) << block.title;
            continue;
        }
        const std::string text = section(block);
        ASSERT_NE(text, "") << block.title << " has no heading";
        const std::size_t begin = text.find("| key |");
        ASSERT_NE(begin, std::string::npos) << block.title << " has no table";
        EXPECT_EQ(text.substr(begin, text.find("\n\n", begin) + 1 - begin), table_of(block)) << block.title;
    }
}

TEST(Reference, HoldsNoTableOfABlockThatIsNot) {
    const std::string all = reference();
    std::ptrdiff_t tables = 0;
    for (std::size_t at = 0; (at = all.find("\n| key |", at)) != std::string::npos; ++at) ++tables;
    EXPECT_EQ(tables, std::ranges::count_if(scene_blocks(), &KeyBlock::available));
}

TEST(Reference, ItsExampleIsAScene) {
    const std::string text = reference();
    const std::size_t begin = text.find("```toml\n") + 8;
    EXPECT_NO_THROW(parse_scene(text.substr(begin, text.find("```", begin) - begin), "REFERENCE.md"));
}

TEST(Keys, EveryAvailableKeyIsUsedByTheSceneThatUsesEverything) {
    const std::string text = everything;
    // One excludes its factor; the others belong to static runs, which exclude much else.
    const std::set<std::string> excluded{"time_step", "load_steps", "breaking"};
    for (const KeyBlock& block : scene_blocks())
        for (const Key& key : block.keys)
            if (block.available && key.available && !excluded.contains(key.name)) {
                EXPECT_NE(text.find(key.name + " = "), std::string::npos) << block.title << " " << key.name;
            }
}

}  // namespace
}  // namespace hibi
