#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "scene/block.hpp"

namespace hibi {

/// One block of the scene: its keys, and how they get from a document to a Scene and back.
struct SceneBlock {
    KeyBlock keys;
    std::vector<KeyBlock> inner{};  ///< tables that stand inside it
    std::function<void(const Value& document, ReadContext&, Scene&)> read{};
    std::function<std::string(const Scene&)> write{};  ///< as TOML
    /// Rules between keys, judged when the whole scene has been read.
    std::vector<std::function<void(const Scene&, Problems&)>> checks{};
};

/// Reports names of a [[block]] that are no names or stand there twice: they go into messages, headers of
/// files and columns of tables.
void check_names(const std::vector<std::string>& names, const std::string& block, Problems& problems);

/// A [block] that stands once. Where the member is optional, it is there where the block is.
template <class Spec, class Member>
SceneBlock single_block(const Block<Spec>& block, Member member) {
    const std::string name = block.keys.name, title = block.keys.title;
    SceneBlock result{block.keys, block.inner};
    result.read = [=](const Value& document, ReadContext& context, Scene& scene) {
        const Value* value = document.find(name);
        if (!value || value->kind != Value::Kind::table) return;
        BlockReader reader(context, *value, scene_block(name), name, title);
        auto& to = std::invoke(member, scene);
        if constexpr (OptionalValue<decltype(to)>)
            block.read(reader, to.emplace(block.initial));
        else
            block.read(reader, to);
    };
    result.write = [=](const Scene& scene) -> std::string {
        WrittenKeys out{scene};
        const auto& from = std::invoke(member, scene);
        if constexpr (OptionalValue<decltype(from)>) {
            if (!from) return "";
            block.write(out, *from);
        } else {
            block.write(out, from);
        }
        return "\n" + title + "\n" + out.in_lines();
    };
    return result;
}

/// A [[block]] that may stand several times. Each has the key `name`, by default the block's with a number.
template <class Spec>
SceneBlock list_block(const Block<Spec>& block, std::vector<Spec> Scene::*member) {
    const std::string name = block.keys.name, title = block.keys.title;
    SceneBlock result{block.keys, block.inner};
    result.read = [=](const Value& document, ReadContext& context, Scene& scene) {
        const Value* value = document.find(name);
        if (!value || value->kind != Value::Kind::array) return;
        for (std::size_t i = 0; i < value->items.size(); ++i) {
            if (value->items[i].kind != Value::Kind::table) continue;
            BlockReader reader(context, value->items[i], scene_block(name), fmt::format("{}/{}", name, i),
                               title);
            Spec spec = block.initial;
            spec.name = fmt::format("{}{}", name, (scene.*member).size() + 1);
            block.read(reader, spec);
            (scene.*member).push_back(spec);
        }
    };
    result.write = [=](const Scene& scene) {
        std::string text;
        for (const Spec& spec : scene.*member) {
            WrittenKeys out{scene};
            block.write(out, spec);
            text += "\n" + title + "\n" + out.in_lines();
        }
        return text;
    };
    result.checks.push_back([=](const Scene& scene, Problems& problems) {
        std::vector<std::string> names;
        for (const Spec& spec : scene.*member) names.push_back(spec.name);
        check_names(names, name, problems);
    });
    return result;
}

/// Tables [block.NAME], one for each name. Each has a member `name`.
template <class Spec>
SceneBlock named_block(const Block<Spec>& block, std::vector<Spec> Scene::*member) {
    const std::string name = block.keys.name;
    SceneBlock result{block.keys, block.inner};
    result.read = [=](const Value& document, ReadContext& context, Scene& scene) {
        const Value* value = document.find(name);
        if (!value || value->kind != Value::Kind::table) return;
        for (const Entry& entry : value->entries) {
            const std::string path = fmt::format("{}/{}", name, (scene.*member).size());
            if (entry.value.kind != Value::Kind::table) {
                context.problems.add(
                    path, entry.place,
                    fmt::format("[{0}] holds {0}s by name; found the key \"{1}\"", name, entry.key),
                    fmt::format("write [{}.NAME] above it", name));
                return;
            }
            BlockReader reader(context, entry.value, scene_block(name), path,
                               fmt::format("[{}.{}]", name, entry.key));
            Spec spec = block.initial;
            spec.name = entry.key;
            block.read(reader, spec);
            (scene.*member).push_back(spec);
        }
    };
    result.write = [=](const Scene& scene) {
        std::string text;
        for (const Spec& spec : scene.*member) {
            WrittenKeys out{scene};
            block.write(out, spec);
            text += fmt::format("\n[{}.{}]\n{}", name, toml_key(spec.name), out.in_lines());
        }
        return text;
    };
    return result;
}

}  // namespace hibi
