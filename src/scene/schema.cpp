#include "scene/schema.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/units.hpp"
#include "scene/document.hpp"
#include "scene/expression.hpp"
#include "scene/keys.hpp"

namespace hibi {

namespace {

using Json = nlohmann::ordered_json;  // editors offer the keys in the order of the table

Json block_schema(const KeyBlock& block);

Json json_of(const Value& value) {
    Json json;
    switch (value.kind) {
        case Value::Kind::text:
        case Value::Kind::date:
            return value.text;
        case Value::Kind::number:
            return value.number;
        case Value::Kind::integer:
            return value.integer;
        case Value::Kind::boolean:
            return value.boolean;
        case Value::Kind::array:
            json = Json::array();
            for (const Value& item : value.items) json.push_back(json_of(item));
            return json;
        case Value::Kind::table:
            json = Json::object();
            for (const Entry& entry : value.entries) json[entry.key] = json_of(entry.value);
            return json;
    }
    return json;
}

/// A value as it is written in a scene; nothing where `text` is none.
std::optional<Json> written(const std::string& text) {
    std::vector<SceneError> errors;
    const Value document = parse_document("value = " + text, errors);
    if (!errors.empty()) return {};
    return json_of(*document.find("value"));
}

/// The default as a value, where the table gives one and not a rule such as "the file's name".
std::optional<Json> default_value(const Key& key) {
    if (std::ranges::find(key.choices, key.standard) != key.choices.end()) return key.standard;
    if (const auto value = written(key.standard)) return value;
    if (key.kind != KeyKind::quantity) return {};
    try {
        if (Expression(key.standard, {}).dimension() == dimension_of(key.unit)) return key.standard;
    } catch (const ExpressionError&) {
    }
    return {};
}

Json list_of_schemas(const Json& items) { return {{"type", "array"}, {"items", items}}; }

/// As many entries as there are axes.
Json per_axis(const Json& items) {
    Json schema = list_of_schemas(items);
    schema["minItems"] = schema["maxItems"] = 2;
    return schema;
}

/// The range of a key, for values that are written as plain numbers.
void limit(Json& schema, const Range& range) {
    const auto end = [&](const char* included, const char* excluded, const Range::End& its) {
        schema[its.included ? included : excluded] = its.value;
    };
    if (range.is_limited_below()) end("minimum", "exclusiveMinimum", range.low);
    if (range.is_limited_above()) end("maximum", "exclusiveMaximum", range.high);
}

/// What a key may hold.
Json value_schema(const Key& key) {
    const Json text = {{"type", "string"}};
    const Json quantity = {{"type", {"string", "number"}}};
    const Json choice = {{"type", "string"}, {"enum", key.choices}};
    Json schema;
    switch (key.kind) {
        case KeyKind::text:
        case KeyKind::condition:
            return text;
        case KeyKind::flag:
            return {{"type", "boolean"}};
        case KeyKind::integer:
            return {{"type", {"string", "integer"}}};
        case KeyKind::choice:
            return choice;
        case KeyKind::choices:
        case KeyKind::names:
            schema = list_of_schemas(key.kind == KeyKind::names ? text : choice);
            schema["uniqueItems"] = true;
            return schema;
        case KeyKind::quantity:
        case KeyKind::moment:
            return quantity;
        case KeyKind::moments:
            return list_of_schemas(quantity);
        case KeyKind::vector:
        case KeyKind::point:
            return per_axis(quantity);
        case KeyKind::points:
            return list_of_schemas(per_axis(quantity));
        case KeyKind::range:
            return {{"anyOf", {Json{{"const", "run"}}, per_axis(quantity)}}};
        case KeyKind::size:
            return per_axis({{"type", "integer"},
                             {"minimum", least_pixels},
                             {"maximum", most_pixels},
                             {"multipleOf", 2}});
        case KeyKind::table:
            return block_schema(scene_block(key.unit));
        case KeyKind::tables:
            return list_of_schemas(block_schema(scene_block(key.unit)));
    }
    return schema;
}

bool is_table(const Key& key) { return key.kind == KeyKind::table || key.kind == KeyKind::tables; }

/// Meaning, unit, range, default and example in words: what an editor shows.
std::string description(const Key& key) {
    std::string text = key.meaning.empty() ? "" : key.meaning + "\n\n";
    if (!key.unit.empty() && !is_table(key)) text += fmt::format("Unit: {}. ", key.unit);
    if (const std::string range = key.range.words(); !range.empty())
        text += fmt::format("Range: {}. ", range);
    if (key.standard.starts_with("required"))
        text += fmt::format("R{}. ", key.standard.substr(1));
    else if (!key.standard.empty())
        text += fmt::format("Default: {}. ", key.standard);
    return text + fmt::format("Example: `{} = {}`", key.name, key.example);
}

Json key_schema(const Key& key) {
    Json schema = value_schema(key);
    limit(schema, key.range);
    schema["description"] = description(key);
    if (const auto value = default_value(key)) schema["default"] = *value;
    if (const auto value = written(key.example)) schema["examples"] = Json::array({*value});
    return schema;
}

/// The keys of one block, required ones and no others.
Json block_schema(const KeyBlock& block) {
    Json properties = Json::object(), required = Json::array();
    for (const Key& key : block.keys) {
        if (!key.available) continue;
        properties[key.name] = key_schema(key);
        if (key.standard == "required") required.push_back(key.name);
    }
    Json schema = {{"type", "object"}, {"description", block.meaning}, {"properties", properties}};
    if (!required.empty()) {
        schema["required"] = required;
        schema["x-taplo"] = {{"initKeys", required}};  // written along when the block is completed
    }
    schema["additionalProperties"] = false;
    return schema;
}

}  // namespace

std::string scene_schema() {
    Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Hibi scene"}};
    schema.update(block_schema(scene_block("")));
    schema["properties"]["params"] = {
        {"type", "object"},
        {"description",
         "Names of your own, each with a quantity, a number or an expression over those above it."},
        {"additionalProperties", {{"type", {"string", "number"}}}}};
    for (const KeyBlock& block : scene_blocks()) {
        if (block.name.empty() || block.form == KeyBlock::Form::inner || !block.available) continue;
        Json its = block_schema(block);
        if (block.form == KeyBlock::Form::named)
            its = {{"type", "object"}, {"description", block.meaning}, {"additionalProperties", its}};
        else if (block.form == KeyBlock::Form::list)
            its = {{"type", "array"}, {"description", block.meaning}, {"items", its}};
        if (!block.words.empty())
            its = {{"description", block.meaning},
                   {"anyOf", {Json{{"type", "string"}, {"enum", block.words}}, its}}};
        schema["properties"][block.name] = its;
        if (block.required) schema["required"].push_back(block.name);
    }
    return schema.dump(2) + "\n";
}

}  // namespace hibi
