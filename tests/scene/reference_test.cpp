#include <gtest/gtest.h>

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

TEST(Reference, NamesEveryKeyWithItsMeaningDefaultAndChoices) {
    for (const KeyBlock& block : scene_blocks()) {
        if (!block.available) {
            EXPECT_NE(reference().find("`" + block.title + "`"), std::string::npos) << block.title;
            continue;
        }
        const std::string text = section(block);
        EXPECT_NE(text, "") << block.title;
        for (const Key& key : block.keys) {
            if (!key.available) continue;
            const std::size_t row = text.find("\n| `" + key.name + "` |");
            ASSERT_NE(row, std::string::npos) << block.title << " " << key.name;
            const std::string line = text.substr(row + 1, text.find('\n', row + 1) - row - 1);
            EXPECT_NE(line.find(key.meaning), std::string::npos) << line;
            EXPECT_NE(line.find("| `" + key.example + "` |"), std::string::npos) << line;
            EXPECT_NE(line.find("| " + (key.standard.empty() ? "absent" : key.standard) + " |"),
                      std::string::npos)
                << line;
            for (const std::string& choice : key.choices)
                EXPECT_NE(line.find("`" + choice + "`"), std::string::npos) << line;
        }
    }
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
