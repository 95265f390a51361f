#include "scene/schema.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scene/everything.hpp"
#include "scene/keys.hpp"
#include "scene/read.hpp"
#include "support/call.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Form = KeyBlock::Form;

/// Where the keys of a block stand in the schema.
Json properties_of(const Json& schema, const KeyBlock& block) {
    Json place = schema;
    if (!block.name.empty()) place = schema["properties"][block.name];
    if (block.form == Form::list) place = place["items"];
    if (block.form == Form::named) place = place["additionalProperties"];
    if (!block.words.empty()) {
        EXPECT_EQ(place["anyOf"][0]["enum"], block.words) << block.title;
        place = place["anyOf"][1];
    }
    return place;
}

/// Every available key and what the table says of it, inner tables included.
void expect_keys(const Json& place, const KeyBlock& block) {
    EXPECT_EQ(place["additionalProperties"], false) << block.title;
    std::vector<std::string> required;
    for (const Key& key : block.keys) {
        const std::string label = block.title + " " + key.name;
        ASSERT_EQ(place["properties"].contains(key.name), key.available) << label;
        if (!key.available) continue;
        const Json its = place["properties"][key.name];
        const std::string described = its["description"];
        for (const std::string& part : {key.meaning, key.example})
            EXPECT_NE(described.find(part), described.npos) << label << ": " << described;
        if (key.standard == "required") required.push_back(key.name);
        const bool table = key.kind == KeyKind::table || key.kind == KeyKind::tables;
        if (table) {
            expect_keys(key.kind == KeyKind::table ? its : its["items"], scene_block(key.unit));
            continue;
        }
        if (!key.unit.empty()) {
            EXPECT_NE(described.find("Unit: " + key.unit + "."), described.npos) << label;
        }
        EXPECT_EQ(its.contains("minimum") || its.contains("exclusiveMinimum"), key.range.is_limited_below())
            << label;
        EXPECT_EQ(its.contains("maximum") || its.contains("exclusiveMaximum"), key.range.is_limited_above())
            << label;
        const Json& values = key.kind == KeyKind::choices ? its["items"] : its;
        EXPECT_EQ(values.value("enum", std::vector<std::string>{}), key.choices) << label;
    }
    EXPECT_EQ(place.value("required", std::vector<std::string>{}), required) << block.title;
}

TEST(Schema, HoldsEveryAvailableKeyAndNoOther) {
    const Json schema = Json::parse(scene_schema());
    EXPECT_EQ(schema["$schema"], "http://json-schema.org/draft-07/schema#");
    int blocks = 0;
    for (const KeyBlock& block : scene_blocks()) {
        if (block.form == Form::inner || block.name.empty()) continue;
        ASSERT_EQ(schema["properties"].contains(block.name), block.available) << block.title;
        if (!block.available) continue;
        expect_keys(properties_of(schema, block), block);
        ++blocks;
    }
    EXPECT_EQ(schema["properties"].size(), scene_block("").keys.size() + blocks + 1);  // and params
    EXPECT_EQ(schema["required"], Json({"material", "body", "run"}));
    EXPECT_EQ(schema["additionalProperties"], false);
}

TEST(Schema, DefaultsAreValuesWhereTheTableGivesValues) {
    const Json blocks = Json::parse(scene_schema())["properties"];
    const auto standard = [&](const char* block, const char* key) {
        return blocks[block]["properties"][key].value("default", Json());
    };
    EXPECT_EQ(standard("model", "thickness"), "1 m");
    EXPECT_EQ(standard("model", "influence"), 2.1);
    EXPECT_EQ(standard("model", "assumption"), "plane stress");
    EXPECT_EQ(standard("view", "size"), Json({1920, 1080}));
    EXPECT_EQ(standard("view", "window"), Json());  // the run up to separation
    EXPECT_EQ(standard("run", "time_step_factor"), Json());
    EXPECT_EQ(standard("run", "until"), Json());  // the value of another key
}

/// The scenes of this test, put before taplo, the language server that editors use.
class WebSchema : public testing::Test {
 protected:
    WebSchema() { std::ofstream(schema_) << scene_schema(); }

    fs::path write(const std::string& name, const std::string& text) {
        const fs::path file = folder_.path() / (name + ".toml");
        std::ofstream(file) << text;
        return file;
    }
    Answer lint(const std::vector<fs::path>& files) const {
        std::string command =
            HIBI_WEB "/node_modules/.bin/taplo lint --no-auto-config --schema file://" + schema_.string();
        for (const fs::path& file : files) command += " " + file.string();
        return call(command);
    }

    TemporaryFolder folder_;
    fs::path schema_ = folder_.path() / "scene.schema.json";
};

TEST_F(WebSchema, AcceptsWhatTheReaderAcceptsAndEveryExampleOfTheTable) {
    std::vector<fs::path> files{write("everything", everything), write("small", small_scene),
                                write("word", "damping = \"quasi-static\"\n" + std::string(small_scene))};
    for (const auto& entry : fs::recursive_directory_iterator(HIBI_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        files.push_back(entry.path());
        std::string first;
        std::getline(std::ifstream(entry.path()), first);
        const std::string up = entry.path().parent_path().filename() == "scenes" ? "../" : "../../";
        EXPECT_EQ(first, "#:schema " + up + "build/release/scene.schema.json") << entry.path();
    }
    EXPECT_GE(files.size(), 2u + 4u);
    std::string examples;
    for (const KeyBlock& block : scene_blocks()) {
        if (block.form == Form::inner || !block.available) continue;
        if (!block.name.empty()) examples += block.title + "\n";
        for (const Key& key : block.keys)
            if (key.available) examples += key.name + " = " + key.example + "\n";
    }
    files.push_back(write("examples", examples));
    const Answer answer = lint(files);
    EXPECT_EQ(answer.status, 0) << answer.out;
    EXPECT_NE(answer.out.find("found files total=" + std::to_string(files.size())), std::string::npos)
        << answer.out;
}

TEST_F(WebSchema, RefusesWhatTheReaderRefusesForItsForm) {
    const std::vector<std::array<std::string, 3>> edits{
        // what is wrong, the line of the small scene, what stands there instead
        {"typo", "ramp =", "rampe ="},
        {"unknown_block", "[run]", "[movies]\nfps = 25\n[run]"},
        {"wrong_kind", "ramp = \"40 s\"", "ramp = true"},
        {"unknown_word", "version = 1", "version = 1\ndamping = \"static\""},
        {"one_axis", "force = [\"0 N\", \"-80 MN\"]", "force = [\"-80 MN\"]"},
        {"unknown_choice", "hold = [\"x\", \"y\"]", "hold = [\"x\", \"up\"]"},
        {"missing_key", "poissons_ratio = 0.3\n", ""},
        {"missing_block", "[run]\nuntil = \"separation + 0.5 s\"\nmax_time = \"60 s\"\n", ""},
        {"wrong_brackets", "[[body]]", "[body]"},
        {"nameless", "[material.concrete]", "[material]"},
    };
    std::vector<fs::path> files{write("right", small_scene)};
    for (const auto& [name, from, to] : edits) {
        std::string text = small_scene;
        ASSERT_NE(text.find(from), text.npos) << name;
        text.replace(text.find(from), from.size(), to);
        EXPECT_THROW(parse_scene(text, name), SceneErrors) << name;
        files.push_back(write(name, text));
    }
    const Answer answer = lint(files);
    EXPECT_NE(answer.status, 0);
    for (std::size_t k = 0; k < files.size(); ++k)
        EXPECT_EQ(
            answer.out.find("schema validation failed path=\"" + files[k].string()) != std::string::npos,
            k > 0)
            << files[k] << answer.out;
}

}  // namespace
}  // namespace hibi
