#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "scene/read.hpp"

namespace hibi {

/// Where something stands in the scene file; line and column count from 1, in characters. Line 0: nowhere.
struct Place {
    int line = 0, column = 0, length = 1;
};

struct Entry;

/// A TOML value with its place.
struct Value {
    enum class Kind { text, number, integer, boolean, array, table, date };
    Kind kind = Kind::table;
    Place place{};
    std::string text{};
    bool plain_text = false;  ///< a text without escapes: its first character stands right behind the quote
    double number = 0;        ///< integers, too; may be infinite or none
    std::int64_t integer = 0;
    bool boolean = false;
    std::vector<Value> items{};    ///< of an array
    std::vector<Entry> entries{};  ///< of a table, in the order of the file

    const Value* find(const std::string& key) const;
};

struct Entry {
    std::string key;
    Place place{};
    Value value{};
};

/// "a text", "a number", "a list", ... for messages.
const char* kind_name(Value::Kind kind);

/// Reads TOML. What is no TOML, or no text at all, is reported in `errors` and gives an empty table.
Value parse_document(const std::string& source, std::vector<SceneError>& errors);

}  // namespace hibi
