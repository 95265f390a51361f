#pragma once
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

/// One key of one block. Reading, unknown-key suggestions, the reference and its test all walk this table.
struct Key {
    std::string name;
    KeyKind kind = KeyKind::text;
    std::string unit{};      ///< SI unit of a quantity, "" for a plain number; the block of a table
    std::string standard{};  ///< the default in words; "required"; or "" where absence means absence
    std::string meaning{};
    std::string example{};  ///< a value as it would be written
    std::vector<std::string> choices{};
    bool varies = false;    ///< may be an expression over the position, and in loads over t
    bool available = true;  ///< false: known, but not built yet
};

struct KeyBlock {
    std::string name;   ///< "load"; "" for the top of the file
    std::string title;  ///< as it is written and named in messages, "[[load]]"
    enum class Form { single, named, list, inner } form = Form::single;
    std::string meaning{};
    std::vector<Key> keys{};
    bool available = true;
    bool required = false;  ///< without it there is no scene
    std::vector<std::string> words{};  ///< texts that may stand in place of the block: name = "word"

    const Key* find(const std::string& key) const;
    std::vector<std::string> key_names() const;
};

const std::vector<KeyBlock>& scene_blocks();
/// Throws std::out_of_range.
const KeyBlock& scene_block(const std::string& name);

}  // namespace hibi
