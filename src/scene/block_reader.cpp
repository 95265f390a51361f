#include "scene/block_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "scene/suggest.hpp"

namespace hibi {

namespace {

std::string quoted(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "\"" : i + 1 == names.size() ? " or \"" : ", \"") + names[i] + "\"";
    return text;
}

}  // namespace

BlockReader::BlockReader(ReadContext& context, const Value& table, const KeyBlock& block, std::string path,
                         std::string title)
    : context_(context), table_(table), block_(block), path_(std::move(path)), title_(std::move(title)) {
    context_.problems.stands_at(path_, table.place);
    for (const Entry& entry : table.entries) {
        const Key* key = block.find(entry.key);
        if (!key) {
            std::string message = fmt::format("unknown key \"{}\" in {}", entry.key, title_);
            const auto near = context_.problems.many() ? std::nullopt : nearest(entry.key, block.key_names());
            if (near) message += fmt::format("; did you mean \"{}\"?", *near);
            std::string hint = near ? "" : "known: " + list_of(block.key_names());
            for (const KeyBlock& other : scene_blocks())
                if (other.name == entry.key && !other.words.empty())
                    hint = "it stands at the top of the file, above the first block";
            context_.problems.add(path_ + "/" + entry.key, entry.place, message, hint);
            continue;
        }
        context_.problems.stands_at(path_ + "/" + entry.key, entry.value.place);
        if (!key->available)
            context_.problems.add(path_ + "/" + entry.key, entry.place,
                                  fmt::format("{} {}: not available yet", title_, entry.key), "leave it out");
    }
    for (const Key& key : block.keys)
        if (key.standard == "required" && !has(key.name))
            fail(key.name, fmt::format("missing key \"{}\" in {}", key.name, title_),
                 fmt::format("for example: {} = {}", key.name, key.example));
}

void BlockReader::fail(const std::string& key, const std::string& message, const std::string& hint) {
    context_.problems.add(path(key), message, hint);
}

const Value* BlockReader::find(const std::string& key, KeyKind kind) const {
    const Key* known = block_.find(key);
    assert(known && known->kind == kind);
    static_cast<void>(known);
    static_cast<void>(kind);
    return table_.find(key);
}

std::string BlockReader::hint(const std::string& key) const {
    return fmt::format("for example: {} = {}", key, block_.find(key)->example);
}

void BlockReader::wrong(const std::string& key, const Value& value, const std::string& sub_path,
                        const std::string& wanted) {
    const std::string found =
        value.kind == Value::Kind::text ? fmt::format("\"{}\"", value.text) : kind_name(value.kind);
    context_.problems.add(sub_path, value.place,
                          fmt::format("{} needs {}; found {}", label(key), wanted, found), hint(key));
}

std::optional<std::string> BlockReader::text(const std::string& key) {
    if (block_.find(key)->kind == KeyKind::choice) return choice(key);
    const Value* value = find(key, KeyKind::text);
    if (!value) return {};
    if (value->kind != Value::Kind::text) {
        wrong(key, *value, path(key), "a text in quotes");
        return {};
    }
    return value->text;
}

std::optional<bool> BlockReader::flag(const std::string& key) {
    const Value* value = find(key, KeyKind::flag);
    if (!value) return {};
    if (value->kind != Value::Kind::boolean) {
        wrong(key, *value, path(key), "true or false");
        return {};
    }
    return value->boolean;
}

std::optional<std::string> BlockReader::choice(const std::string& key) {
    const Value* value = find(key, KeyKind::choice);
    if (!value) return {};
    const auto& known = block_.find(key)->choices;
    if (value->kind == Value::Kind::text && std::find(known.begin(), known.end(), value->text) != known.end())
        return value->text;
    if (value->kind != Value::Kind::text) {
        wrong(key, *value, path(key), quoted(known));
        return {};
    }
    const auto near = nearest(value->text, known);
    context_.problems.add(path(key), value->place, fmt::format("{}: no \"{}\"", label(key), value->text),
                          near ? fmt::format("did you mean \"{}\"?", *near) : "known: " + list_of(known));
    return {};
}

std::optional<std::vector<std::string>> BlockReader::list_of_texts(const std::string& key,
                                                                   const Value& value) {
    std::vector<std::string> list;
    if (value.kind != Value::Kind::array) {
        wrong(key, value, path(key), "a list of texts");
        return {};
    }
    for (std::size_t i = 0; i < value.items.size(); ++i) {
        const std::string sub_path = fmt::format("{}/{}", path(key), i);
        context_.problems.stands_at(sub_path, value.items[i].place);
        if (value.items[i].kind != Value::Kind::text)
            wrong(key, value.items[i], sub_path, "texts in quotes");
        else if (std::find(list.begin(), list.end(), value.items[i].text) != list.end())
            context_.problems.add(sub_path, fmt::format("{}: \"{}\" twice", label(key), value.items[i].text));
        else
            list.push_back(value.items[i].text);
    }
    if (context_.problems.concerns(path(key))) return {};
    return list;
}

std::optional<std::vector<std::string>> BlockReader::choices(const std::string& key) {
    const Value* value = find(key, KeyKind::choices);
    if (!value) return {};
    const auto list = list_of_texts(key, *value);
    if (!list) return {};
    const auto& known = block_.find(key)->choices;
    for (std::size_t i = 0; i < list->size(); ++i)
        if (std::find(known.begin(), known.end(), (*list)[i]) == known.end()) {
            const auto near = nearest((*list)[i], known);
            context_.problems.add(
                fmt::format("{}/{}", path(key), i), fmt::format("{}: no \"{}\"", label(key), (*list)[i]),
                near ? fmt::format("did you mean \"{}\"?", *near) : "known: " + list_of(known));
        }
    if (context_.problems.concerns(path(key))) return {};
    return list;
}

std::optional<std::vector<std::string>> BlockReader::names(const std::string& key) {
    if (block_.find(key)->kind == KeyKind::choices) return choices(key);
    const Value* value = find(key, KeyKind::names);
    return value ? list_of_texts(key, *value) : std::nullopt;
}

std::optional<int> BlockReader::body(const std::string& key) {
    const auto name = text(key);
    if (!name) return {};
    std::vector<std::string> known;
    for (const BodySpec& body : context_.scene.bodies) {
        if (body.name == *name) return static_cast<int>(known.size());
        known.push_back(body.name);
    }
    const auto near = nearest(*name, known);
    fail(key, fmt::format("no body \"{}\"", *name),
         near ? fmt::format("did you mean \"{}\"?", *near) : "known: " + list_of(known));
    return {};
}

std::optional<std::array<int, 2>> BlockReader::size(const std::string& key) {
    const Value* value = find(key, KeyKind::size);
    if (!value) return {};
    std::array<int, 2> result{};
    if (value->kind != Value::Kind::array || value->items.size() != 2) {
        wrong(key, *value, path(key), "[width, height]");
        return {};
    }
    for (int k = 0; k < 2; ++k) {
        const Value& item = value->items[k];
        const std::string sub_path = fmt::format("{}/{}", path(key), k);
        context_.problems.stands_at(sub_path, item.place);
        if (item.kind != Value::Kind::integer || item.integer < least_pixels || item.integer > most_pixels) {
            context_.problems.add(sub_path,
                                  fmt::format("{} needs whole numbers of pixels, {} to {}", label(key),
                                              least_pixels, most_pixels),
                                  hint(key));
            continue;
        }
        result[k] = static_cast<int>(item.integer);
        if (result[k] % 2 != 0)
            context_.problems.add(
                sub_path, fmt::format("{}: {} pixels; a film needs even numbers", label(key), result[k]),
                fmt::format("for example {}", result[k] + 1));
    }
    if (context_.problems.concerns(path(key))) return {};
    return result;
}

std::optional<BlockReader> BlockReader::table(const std::string& key) {
    const Value* value = find(key, KeyKind::table);
    if (!value) return {};
    if (value->kind != Value::Kind::table) {
        wrong(key, *value, path(key), "a table { ... }");
        return {};
    }
    return BlockReader(context_, *value, scene_block(block_.find(key)->unit), path(key), label(key));
}

std::vector<BlockReader> BlockReader::tables(const std::string& key) {
    std::vector<BlockReader> list;
    const Value* value = find(key, KeyKind::tables);
    if (!value) return list;
    if (value->kind != Value::Kind::array) {
        wrong(key, *value, path(key), "a list of tables [{ ... }]");
        return list;
    }
    for (std::size_t i = 0; i < value->items.size(); ++i) {
        const std::string sub_path = fmt::format("{}/{}", path(key), i);
        if (value->items[i].kind != Value::Kind::table)
            wrong(key, value->items[i], sub_path, "tables { ... }");
        else
            list.emplace_back(context_, value->items[i], scene_block(block_.find(key)->unit), sub_path,
                              label(key));
    }
    return list;
}

std::optional<std::string> BlockReader::one_of(const std::vector<std::string>& keys,
                                               const std::string& what) {
    std::optional<std::string> given;
    for (const std::string& key : keys) {
        if (!has(key)) continue;
        if (given) {
            fail(key, fmt::format("{} has both {} and {}", title_, *given, key), "keep one of them");
            return {};
        }
        given = key;
    }
    if (!given) fail(what, fmt::format("{} needs a {}: {}", title_, what, quoted(keys)), hint(keys.front()));
    return given;
}

}  // namespace hibi
