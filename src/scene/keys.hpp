#pragma once
#include <limits>
#include <string>
#include <vector>

namespace hibi {

/// What a key of the scene holds.
enum class KeyKind {
    text,
    flag,  ///< true or false
    integer,
    choice,     ///< one of `choices`
    choices,    ///< a list of some of `choices`
    names,      ///< a list of names
    quantity,   ///< a value of dimension `unit`
    vector,     ///< one quantity per axis
    point,      ///< [x, y]
    points,     ///< [[x, y], ...]
    moment,     ///< an event, perhaps plus or minus a time, or a time
    moments,    ///< a list of moments
    condition,  ///< a selection of particles
    range,      ///< "run" or [low, high]
    size,       ///< [width, height], pixels
    table,      ///< { ... } with the keys of block `unit`
    tables      ///< [{ ... }, ...] with the keys of block `unit`
};

/// Pixels of a picture, along each side.
constexpr int least_pixels = 64, most_pixels = 16384;

/// The values that a number of the scene may have (SI).
struct Range {
    struct End {
        double value;
        bool included = true;  ///< whether the end itself is allowed
        std::string hint{};    ///< a way out, told where a value lies beyond this end
    };
    End low{-std::numeric_limits<double>::infinity()}, high{std::numeric_limits<double>::infinity()};

    bool is_limited_below() const { return low.value > -std::numeric_limits<double>::infinity(); }
    bool is_limited_above() const { return high.value < std::numeric_limits<double>::infinity(); }
    /// The end beyond which the value lies; null where the value is allowed.
    const End* passed_by(double value) const;
    /// "above 0 and below 1", "from 1 to 240"; empty where every number is allowed.
    std::string words() const;
};

/// One key of one block, as the reader, the messages, the schema and the reference know it.
struct Key {
    std::string name;
    KeyKind kind = KeyKind::text;
    std::string unit{};  ///< SI unit of a quantity, "" for a plain number; the block of a table
    std::string meaning{};
    std::string example{};  ///< a value as it would be written
    std::vector<std::string> choices{};
    std::string standard{};  ///< the default in words; "required"; or "" where absence means absence
    Range range{};
    bool varies = false;          ///< may be an expression over the position, and in loads over t
    bool ends_something = false;  ///< a moment that has to come after the start and before the end
    bool available = true;        ///< false: known, but not built yet
};

// What is said of a key where it is bound, each a function of the key.
constexpr auto required = [](Key& key) { key.standard = "required"; };
constexpr auto ends_something = [](Key& key) { key.ends_something = true; };
constexpr auto not_available_yet = [](Key& key) { key.available = false; };
constexpr auto may_vary = [](Key& key) { key.varies = true; };
/// States a default that is a rule and not a value.
inline auto by_default(const std::string& words) {
    return [=](Key& key) { key.standard = words; };
}
inline auto one_of(const std::vector<std::string>& choices) {
    return [=](Key& key) {
        key.kind = key.kind == KeyKind::text ? KeyKind::choice : KeyKind::choices;
        key.choices = choices;
    };
}
inline auto limited_below(const Range::End& low) {
    return [=](Key& key) { key.range.low = low; };
}
inline auto limited_above(const Range::End& high) {
    return [=](Key& key) { key.range.high = high; };
}
inline auto above(double low, const std::string& hint = {}) { return limited_below({low, false, hint}); }
inline auto at_least(double low, const std::string& hint = {}) { return limited_below({low, true, hint}); }
inline auto below(double high, const std::string& hint = {}) { return limited_above({high, false, hint}); }
inline auto at_most(double high, const std::string& hint = {}) { return limited_above({high, true, hint}); }

struct KeyBlock {
    enum class Form { single, named, list, inner };

    std::string name;  ///< "load"; "" for the top of the file
    Form form = Form::single;
    std::string meaning{};
    std::string title{};  ///< as it is written and named in messages, "[[load]]"
    std::vector<Key> keys{};
    bool available = true;
    bool required = false;                                               ///< without it there is no scene
    std::string if_missing = "`hibi new` writes a scene to start from";  ///< the way out where it is required
    std::vector<std::string> words{};  ///< texts that may stand in place of the block: name = "word"

    const Key* find(const std::string& key) const;
    std::vector<std::string> key_names() const;
};

/// Every block, those inside others included, in the order of the written scene.
const std::vector<KeyBlock>& scene_blocks();
/// Throws std::out_of_range.
const KeyBlock& scene_block(const std::string& name);

}  // namespace hibi
