#pragma once
#include <fmt/format.h>

#include <concepts>
#include <functional>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/block_reader.hpp"
#include "scene/keys.hpp"
#include "scene/scene.hpp"
#include "scene/toml_text.hpp"

namespace hibi {

/// The keys of one table of the scene that is being written, in order, with their values as TOML.
struct WrittenKeys {
    const Scene& scene;
    std::vector<std::pair<std::string, std::string>> lines{};

    void add(const std::string& key, std::string value) { lines.emplace_back(key, std::move(value)); }
    std::string in_lines() const;      ///< each "key = value\n"
    std::string in_one_table() const;  ///< "{ key = value, ... }"
};

/// How the value of a key is read into a member of type T, and what kind of key that makes it.
template <class T>
constexpr auto access_to() {
    if constexpr (std::is_same_v<T, bool>)
        return std::pair{KeyKind::flag, &BlockReader::flag};
    else if constexpr (std::is_integral_v<T>)
        return std::pair{KeyKind::integer, &BlockReader::integer};
    else if constexpr (std::is_same_v<T, std::string>)
        return std::pair{KeyKind::text, &BlockReader::text};
    else if constexpr (std::is_same_v<T, std::vector<std::string>>)
        return std::pair{KeyKind::names, &BlockReader::names};
    else if constexpr (std::is_same_v<T, Vec<2>>)
        return std::pair{KeyKind::point, &BlockReader::point};
    else if constexpr (std::is_same_v<T, Moment>)
        return std::pair{KeyKind::moment, &BlockReader::moment};
    else if constexpr (std::is_same_v<T, std::vector<Moment>>)
        return std::pair{KeyKind::moments, &BlockReader::moments};
    else
        return std::pair{KeyKind::quantity, &BlockReader::quantity};
}

template <class T>
struct Held {
    using Type = T;
};
template <class T>
struct Held<std::optional<T>> {
    using Type = T;
};

template <class T>
concept OptionalValue = requires(std::remove_cvref_t<T> value) {
    value.reset();
};

/// Sets a value that was read; keeps the default otherwise.
template <class To, class From>
void set(To& to, const std::optional<From>& from) {
    if (from) to = *from;
}

/// The keys of one block of the scene, each bound once to the member of Spec that holds its value. Everything
/// that is done with keys walks this list: reading, writing, checks of ranges, schema, and the test of the
/// reference.
///
/// A member is given as a pointer to member, or as a function of the Spec that returns a reference, or a
/// pointer that is null where there is no place for the value. An optional member that is empty is not
/// written. The default that is stated is the one of `initial`, unless the key states another.
template <class Spec>
class Block {
 public:
    using Form = KeyBlock::Form;
    using Read = std::function<void(BlockReader&, Spec&)>;
    using Write = std::function<void(WrittenKeys&, const Spec&)>;

    /// Where a member is; null where there is no place for its value.
    template <class Member, class Its>
    static auto* place(const Member& member, Its& spec) {
        if constexpr (std::is_pointer_v<std::invoke_result_t<Member, Its&>>)
            return std::invoke(member, spec);
        else
            return &std::invoke(member, spec);
    }
    template <class Member>
    using ValueAt = std::remove_cvref_t<decltype(*place(std::declval<Member>(), std::declval<Spec&>()))>;

    KeyBlock keys;
    std::vector<KeyBlock> inner{};  ///< blocks that stand inside this one
    Spec initial;                   ///< every key at its default

    Block(const std::string& name, Form form, const std::string& meaning, Spec defaults = {})
        : keys{.name = name, .form = form, .meaning = meaning}, initial(std::move(defaults)) {
        keys.title = fmt::format(fmt::runtime(form == Form::single  ? "[{}]"
                                              : form == Form::named ? "[{}.NAME]"
                                              : form == Form::list  ? "[[{}]]"
                                                                    : "{}"),
                                 name);
    }

    /// What is read together with another key, or refused.
    template <class... Attributes>
    void described(Key key, const Attributes&... attributes) {
        (attributes(key), ...);
        keys.keys.push_back(std::move(key));
    }
    /// A key with its own way of reading and writing.
    template <class... Attributes>
    void bound(Key key, Read read_it, Write write_it, const Attributes&... attributes) {
        static const Scene nothing_else;
        WrittenKeys written{nothing_else};
        write_it(written, initial);
        bindings_.push_back({std::move(read_it), std::move(write_it)});
        if (!written.lines.empty() && written.lines.front().first == key.name)
            key.standard = stated(key, written.lines.front().second);
        described(std::move(key), attributes...);
    }
    /// A key of the kind that the type of its member has.
    template <class Member, class... Attributes>
    void add(const std::string& name, Member member, const std::string& unit, const std::string& meaning,
             const std::string& example, const Attributes&... attributes) {
        using HeldType = typename Held<ValueAt<Member>>::Type;  // what an optional member holds
        constexpr auto access = access_to<HeldType>();
        bound(
            {name, access.first, unit, meaning, example},
            [=](BlockReader& block, Spec& spec) {
                const auto value = (block.*access.second)(name);
                auto* const to = place(member, spec);
                if (!value || !to) return;
                if constexpr (access.first == KeyKind::integer) {
                    if (!std::in_range<HeldType>(*value))
                        return block.fail(name,
                                          fmt::format("{}: {} is too large", block.label(name), *value));
                    *to = static_cast<HeldType>(*value);
                } else {
                    *to = *value;
                }
            },
            [=](WrittenKeys& out, const Spec& spec) {
                const auto* const value = place(member, spec);
                if (!value) return;
                if constexpr (OptionalValue<decltype(*value)>) {
                    if (*value) out.add(name, toml_text(**value));
                } else {
                    out.add(name, toml_text(*value));
                }
            },
            attributes...);
    }
    /// The name of a [[block]], by default the block's with a number.
    void name(const std::string& meaning, const std::string& example) {
        add("name", &Spec::name, "", meaning, example, by_default(fmt::format("{0}1, {0}2, ...", keys.name)));
    }
    /// One of several names, each of which stands for a value.
    template <class Member, class... Attributes>
    void choice_of(const std::string& name, Member member,
                   const std::vector<std::pair<std::string, ValueAt<Member>>>& values,
                   const std::string& meaning, const std::string& example, const Attributes&... attributes) {
        std::vector<std::string> known;
        for (const auto& [word, value] : values) known.push_back(word);
        bound(
            {name, KeyKind::choice, "", meaning, example, known},
            [=](BlockReader& block, Spec& spec) {
                const auto given = block.choice(name);
                auto* const to = place(member, spec);
                for (const auto& [word, value] : values)
                    if (to && given == word) *to = value;
            },
            [=](WrittenKeys& out, const Spec& spec) {
                const auto* const its = place(member, spec);
                for (const auto& [word, value] : values)
                    if (its && *its == value) return out.add(name, toml_text(word));
            },
            attributes...);
    }
    /// One component per axis: a Vec3, or an array of Field, which may vary.
    template <class Member, class... Attributes>
    void vector(const std::string& name, Member member, const std::string& unit, const std::string& meaning,
                const std::string& example, const Attributes&... attributes) {
        using Vector = std::remove_cvref_t<std::invoke_result_t<Member, Spec&>>;
        constexpr bool varies = !std::is_same_v<Vector, Vec3>;
        Key key{name, KeyKind::vector, unit, meaning, example};
        key.varies = varies;
        bound(
            std::move(key),
            [=](BlockReader& block, Spec& spec) {
                const auto components = block.vector(name, false);
                for (int axis = 0; components && axis < 2; ++axis) {
                    const Field& component = *components->at(axis);
                    if constexpr (varies)
                        std::invoke(member, spec)[axis] = component;
                    else
                        std::invoke(member, spec)[axis] = component(Vec3::Zero(), 0);
                }
            },
            [=](WrittenKeys& out, const Spec& spec) {
                const auto& vector = std::invoke(member, spec);
                out.add(name, toml_list({toml_text(vector[0]), toml_text(vector[1])}));
            },
            attributes...);
    }
    /// The size of a picture.
    template <class Member, class... Attributes>
    void size(const std::string& name, Member width, Member height, const std::string& meaning,
              const std::string& example, const Attributes&... attributes) {
        bound(
            {name, KeyKind::size, "", meaning, example},
            [=](BlockReader& block, Spec& spec) {
                const auto pixels = block.size(name);
                if (!pixels) return;
                std::invoke(width, spec) = pixels->at(0);
                std::invoke(height, spec) = pixels->at(1);
            },
            [=](WrittenKeys& out, const Spec& spec) {
                out.add(name, toml_text(std::vector{std::invoke(width, spec), std::invoke(height, spec)}));
            },
            attributes...);
    }
    /// The name of a body, held as its index; -1 stands for all.
    template <class Member, class... Attributes>
    void body(const std::string& name, Member member, const std::string& meaning, const std::string& example,
              const Attributes&... attributes) {
        bound(
            {name, KeyKind::text, "", meaning, example},
            [=](BlockReader& block, Spec& spec) { set(std::invoke(member, spec), block.body(name)); },
            [=](WrittenKeys& out, const Spec& spec) {
                const int index = std::invoke(member, spec);
                if (index >= 0) out.add(name, toml_text(out.scene.bodies[index].name));
            },
            by_default("all bodies"), attributes...);
    }
    /// A table inside the block, named as the key. An optional member is there where the table is. One that
    /// can be compared is not written where it is at its default.
    template <class Inner, class Member, class... Attributes>
    void table(const Block<Inner>& block, Member member, const std::string& meaning,
               const std::string& example, const Attributes&... attributes) {
        const std::string name = block.keys.name;
        add_inner(block);
        bound(
            {name, KeyKind::table, name, meaning, example},
            [=](BlockReader& reader, Spec& spec) {
                auto table = reader.table(name);
                if (!table) return;
                auto& value = std::invoke(member, spec);
                if constexpr (OptionalValue<decltype(value)>)
                    block.read(*table, value.emplace(block.initial));
                else
                    block.read(*table, value);
            },
            [=](WrittenKeys& out, const Spec& spec) {
                const auto& value = std::invoke(member, spec);
                if constexpr (OptionalValue<decltype(value)>) {
                    if (value) out.add(name, block.in_one_table(*value, out.scene));
                } else {
                    if constexpr (std::equality_comparable<Inner>)
                        if (value == block.initial) return;
                    WrittenKeys written{out.scene};
                    block.write(written, value);
                    if (!written.lines.empty()) out.add(name, written.in_one_table());
                }
            },
            by_default(""), attributes...);
    }
    /// A list of tables, named as the key.
    template <class Inner, class Member, class... Attributes>
    void tables(const Block<Inner>& block, Member member, const std::string& meaning,
                const std::string& example, const Attributes&... attributes) {
        const std::string name = block.keys.name;
        add_inner(block);
        bound(
            {name, KeyKind::tables, name, meaning, example},
            [=](BlockReader& reader, Spec& spec) {
                for (BlockReader& table : reader.tables(name)) {
                    Inner part = block.initial;
                    block.read(table, part);
                    std::invoke(member, spec).push_back(part);
                }
            },
            [=](WrittenKeys& out, const Spec& spec) {
                std::vector<std::string> parts;
                for (const Inner& part : std::invoke(member, spec))
                    parts.push_back(block.in_one_table(part, out.scene));
                out.add(name, toml_list(parts));
            },
            attributes...);
    }
    /// The keys of another block among those of this one; `member` holds their values.
    template <class Part, class Member>
    void include(const Block<Part>& part, Member member) {
        keys.keys.insert(keys.keys.end(), part.keys.keys.begin(), part.keys.keys.end());
        inner.insert(inner.end(), part.inner.begin(), part.inner.end());
        bindings_.push_back(
            {[=](BlockReader& block, Spec& spec) { part.read(block, std::invoke(member, spec)); },
             [=](WrittenKeys& out, const Spec& spec) { part.write(out, std::invoke(member, spec)); }});
    }
    template <class Inner>
    void add_inner(const Block<Inner>& block) {
        inner.push_back(block.keys);
        inner.insert(inner.end(), block.inner.begin(), block.inner.end());
    }

    /// What is done once all keys are read: rules between keys of this block.
    void afterwards(Read rule) { afterwards_ = std::move(rule); }

    void read(BlockReader& reader, Spec& spec) const {
        for (const Binding& binding : bindings_) binding.read(reader, spec);
        if (afterwards_) afterwards_(reader, spec);
    }
    void write(WrittenKeys& out, const Spec& spec) const {
        for (const Binding& binding : bindings_) binding.write(out, spec);
    }
    std::string in_one_table(const Spec& spec, const Scene& scene) const {
        WrittenKeys out{scene};
        write(out, spec);
        return out.in_one_table();
    }

 private:
    struct Binding {
        Read read;
        Write write;
    };
    std::vector<Binding> bindings_;
    Read afterwards_;

    /// The default, which was written as `value`, as the tables state it.
    static std::string stated(const Key& key, const std::string& value) {
        if (key.kind == KeyKind::text || key.kind == KeyKind::choice)
            return value.substr(1, value.size() - 2);
        // "0 1/s" would not be a quantity; plain numbers are SI.
        const bool unit_is_named = !key.unit.empty() && !key.unit.starts_with("1/");
        return key.kind == KeyKind::quantity && unit_is_named ? value + " " + key.unit : value;
    }
};

}  // namespace hibi
