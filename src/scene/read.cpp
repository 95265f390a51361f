#include "scene/read.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "base/hash.hpp"
#include "base/units.hpp"
#include "image/shaping.hpp"
#include "image/text.hpp"
#include "scene/blocks/blocks.hpp"
#include "scene/build.hpp"
#include "scene/checks.hpp"
#include "scene/scene_file.hpp"
#include "scene/suggest.hpp"

namespace hibi {

namespace {

bool is_name(const std::string& text) {
    return !text.empty() && !std::isdigit(static_cast<unsigned char>(text[0])) &&
           std::all_of(text.begin(), text.end(),
                       [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; });
}

/// A value given on the command line, in place of one of [params].
void override_parameter(ReadContext& context, const std::string& name, const std::string& text,
                        Quantity& quantity) {
    const std::string path = "-p/" + name;
    try {
        const Expression given(text, context.names);
        if (given.is_condition() || (!given.is_bare_number() && !(given.dimension() == quantity.dimension)))
            context.problems.add(
                path, {},
                fmt::format("-p {0}={1}: {0} is {2}; \"{1}\" is {3}", name, text,
                            dimension_name(quantity.dimension),
                            given.is_condition() ? "a condition" : dimension_name(given.dimension())),
                "");
        else
            quantity.value = given(Vec3::Zero(), 0);
    } catch (const ExpressionError& error) {
        context.problems.add(path, {}, fmt::format("-p {}={}: {}", name, text, error.what()), error.hint);
    }
}

void read_params(const Value& document, const Overrides& overrides, ReadContext& context, Scene& scene) {
    const Value* params = document.find("params");
    std::vector<std::string> known;
    for (const Entry& entry : params ? params->entries : std::vector<Entry>{}) {
        const std::string path = "params/" + entry.key, label = "[params] " + entry.key;
        context.problems.stands_at(path, entry.value.place);
        known.push_back(entry.key);
        std::optional<Quantity> quantity;
        if (!is_name(entry.key) || is_reserved_name(entry.key)) {
            context.problems.add(
                path, entry.place,
                is_reserved_name(entry.key)
                    ? fmt::format("{}: the name has a meaning of its own in expressions", label)
                    : fmt::format("{}: not a name", label),
                "letters, digits and _, for example \"spacing\"");
        } else if (entry.value.kind == Value::Kind::number || entry.value.kind == Value::Kind::integer) {
            if (std::isfinite(entry.value.number))
                quantity = Quantity{entry.value.number, {}};
            else
                context.problems.add(path, fmt::format("{} needs a finite number", label));
        } else if (entry.value.kind == Value::Kind::text) {
            try {
                const Expression formula(entry.value.text, context.names);
                if (formula.is_condition())
                    context.problems.add(path, fmt::format("{} needs a value; \"{}\" is a condition", label,
                                                           entry.value.text));
                else
                    quantity = Quantity{formula(Vec3::Zero(), 0), formula.dimension()};
            } catch (const ExpressionError& error) {
                report_expression(context, path, entry.value, label, error);
            }
        } else {
            context.problems.add(
                path, fmt::format("{} needs a value; found {}", label, kind_name(entry.value.kind)),
                "for example: spacing = \"1 m\"");
        }
        if (!quantity) {
            context.broken_names.insert(entry.key);
            continue;
        }
        std::string text =
            entry.value.kind == Value::Kind::text ? entry.value.text : fmt::format("{}", quantity->value);
        for (const auto& [name, given] : overrides)
            if (name == entry.key) {
                override_parameter(context, name, given, *quantity);
                text = given;
            }
        context.names.params[entry.key] = *quantity;
        scene.params.push_back({entry.key, text, quantity->value, si_symbol(quantity->dimension)});
    }
    for (const auto& [name, given] : overrides) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        const auto near = nearest(name, known);
        context.problems.add("-p/" + name, {},
                             fmt::format("-p {}={}: this scene has no parameter \"{}\"", name, given, name),
                             near            ? fmt::format("did you mean \"{}\"?", *near)
                             : known.empty() ? "it has no [params]"
                                             : "known: " + list_of(known));
    }
}

/// Reports blocks that are unknown, not built yet, or written in the wrong brackets.
void check_blocks(const Value& document, ReadContext& context) {
    const KeyBlock& top = scene_block("");
    std::vector<std::string> known = top.key_names();
    known.push_back("params");
    for (const KeyBlock& block : scene_blocks())
        if (block.form != KeyBlock::Form::inner && !block.name.empty()) known.push_back(block.name);
    for (const Entry& entry : document.entries) {
        if (top.find(entry.key)) continue;
        const std::string shown = entry.value.kind == Value::Kind::array ? fmt::format("[[{}]]", entry.key)
                                  : entry.value.kind == Value::Kind::table
                                      ? fmt::format("[{}]", entry.key)
                                      : fmt::format("{} = ...", entry.key);
        if (std::find(known.begin(), known.end(), entry.key) == known.end()) {
            const bool block =
                entry.value.kind == Value::Kind::array || entry.value.kind == Value::Kind::table;
            std::string message = block ? fmt::format("unknown block {}", shown)
                                        : fmt::format("unknown key \"{}\" at the top of the file", entry.key);
            const auto near = context.problems.many() ? std::nullopt : nearest(entry.key, known);
            if (near) message += fmt::format("; did you mean \"{}\"?", *near);
            context.problems.add(entry.key, entry.place, message, near ? "" : "known: " + list_of(known));
            continue;
        }
        if (entry.key == "params") {
            if (entry.value.kind != Value::Kind::table)
                context.problems.add(entry.key, entry.place, "params is a block", "write [params]");
            continue;
        }
        const KeyBlock& block = scene_block(entry.key);
        if (!block.available)
            context.problems.add(entry.key, entry.place, fmt::format("{}: not available yet", block.title),
                                 "leave it out");
        const bool tables = std::all_of(entry.value.items.begin(), entry.value.items.end(),
                                        [](const Value& item) { return item.kind == Value::Kind::table; });
        if (entry.value.kind == Value::Kind::text &&
            std::find(block.words.begin(), block.words.end(), entry.value.text) != block.words.end())
            continue;
        if (block.form == KeyBlock::Form::list ? entry.value.kind != Value::Kind::array || !tables
                                               : entry.value.kind != Value::Kind::table) {
            std::string hint = "write " + block.title;
            for (const std::string& word : block.words)
                hint += fmt::format(", or {} = \"{}\"", block.name, word);
            context.problems.add(entry.key, entry.place,
                                 fmt::format("{} stands where a block is expected", shown), hint);
        }
    }
}

/// What stands in pictures must have glyphs: to be told now, not when everything has been simulated.
void check_texts(const Value& document, const Scene& scene, Problems& problems) {
    const Value* const title = document.find("title");
    if (problems.fine("title")) try {
            require_glyphs(scene.title);
        } catch (const MissingGlyph& missing) {
            Place place = title ? title->place : document.place;
            if (title && title->plain_text)
                place.column += 1 + static_cast<int>(missing.at), place.length = 1;
            problems.add(
                "title", place,
                fmt::format("title{}: {}", title ? "" : ", which is the file's name", missing.what()),
                title ? "leave the character out, or write a word"
                      : "give the scene a title of its own: title = \"...\"");
        }
    const Value* const materials = document.find("material");
    for (const Entry& entry : materials ? materials->entries : std::vector<Entry>{}) try {
            require_glyphs(entry.key);
        } catch (const MissingGlyph& missing) {
            problems.add(
                "material/name/" + entry.key, entry.place,
                fmt::format("[material.{}]: {}; the name stands in pictures", entry.key, missing.what()),
                "choose another name");
        }
}

/// Fills a scene from a document. What is wrong is told to the problems, and keeps its default.
void read_document(const Value& document, const Overrides& overrides, ReadContext& context, Scene& scene) {
    check_blocks(document, context);
    read_params(document, overrides, context, scene);
    for (const Entry& entry : document.entries) context.problems.stands_at(entry.key, entry.value.place);
    for (const SceneBlock& block : bound_blocks()) block.read(document, context, scene);
    for (const bool single : {true, false})
        for (const KeyBlock& block : scene_blocks()) {
            if (!block.required || (block.form == KeyBlock::Form::single) != single) continue;
            const Value* value = document.find(block.name);
            if (!value || (!single && value->items.empty() && value->entries.empty()))
                context.problems.add(block.name, "missing block " + block.title, block.if_missing);
        }
}

BuiltScene parse(const std::string& text, const std::string& name, const Overrides& overrides,
                 bool assembled) {
    BuiltScene read;
    Scene& scene = read.scene;
    scene.file = name;
    std::vector<SceneError> errors;
    Value document = parse_document(text, errors);
    if (!errors.empty()) throw SceneErrors(name, text, std::move(errors));

    ReadContext context{scene};
    // What is missing as a whole is missed at the end of the file.
    const int lines =
        static_cast<int>(std::count(text.begin(), text.end(), '\n')) + (text.ends_with('\n') ? 0 : 1);
    document.place = {std::max(1, lines), 1, 1};
    read_document(document, overrides, context, scene);
    check_scene(scene, context.moments, context.problems);
    if (assembled) check_texts(document, scene, context.problems);
    if (assembled) read.built = assemble(scene, context.problems);
    if (!context.problems.errors().empty()) throw SceneErrors(name, text, context.problems.errors());
    return read;
}

}  // namespace

Scene parse_scene(const std::string& text, const std::string& name, const Overrides& overrides) {
    return parse(text, name, overrides, true).scene;
}

BuiltScene parse_and_build(const std::string& text, const std::string& name, const Overrides& overrides) {
    return parse(text, name, overrides, true);
}

BuiltScene read_and_build(const std::filesystem::path& file, const Overrides& overrides) {
    return parse_and_build(read_scene_text(file), file.string(), overrides);
}

Scene read_scene(const std::filesystem::path& file, const Overrides& overrides) {
    return read_and_build(file, overrides).scene;
}

Scene read_recorded_scene(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "scene.toml";
    return parse(read_scene_text(file), file.string(), {}, false).scene;
}

std::string write_scene(const Scene& scene) {
    std::string text;
    for (const SceneBlock& block : bound_blocks()) text += block.write(scene);
    return text;
}

std::string scene_hash(const Scene& scene) { return sha256(write_scene(scene)); }

}  // namespace hibi
