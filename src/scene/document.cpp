#include "scene/document.hpp"

// Its assertions abort the program on input as small as "[[[".
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>

#include "scene/prescan.hpp"

namespace hibi {

const Value* Value::find(const std::string& key) const {
    for (const Entry& entry : entries)
        if (entry.key == key) return &entry.value;
    return nullptr;
}

const char* kind_name(Value::Kind kind) {
    switch (kind) {
        case Value::Kind::text:
            return "a text";
        case Value::Kind::number:
        case Value::Kind::integer:
            return "a number";
        case Value::Kind::boolean:
            return "true or false";
        case Value::Kind::array:
            return "a list";
        case Value::Kind::table:
            return "a table";
        case Value::Kind::date:
            return "a date or time of day";
    }
    return "";
}

namespace {

Place place_of(const toml::source_region& region) {
    Place place{static_cast<int>(region.begin.line), static_cast<int>(region.begin.column), 1};
    if (region.end.line == region.begin.line && region.end.column > region.begin.column)
        place.length = static_cast<int>(region.end.column - region.begin.column);
    return place;
}

bool before(const Place& a, const Place& b) {
    return a.line != b.line ? a.line < b.line : a.column < b.column;
}

class Converter {
 public:
    Converter(const std::string& source, std::vector<SceneError>& errors) : errors_(errors) {
        std::size_t begin = 0;
        while (begin <= source.size()) {
            const std::size_t end = std::min(source.find('\n', begin), source.size());
            lines_.push_back(std::string_view(source).substr(begin, end - begin));
            begin = end + 1;
        }
    }

    Value convert(const toml::node& node) {
        Value value;
        value.place = place_of(node.source());
        switch (node.type()) {
            case toml::node_type::table:
                value.kind = Value::Kind::table;
                for (const auto& [key, child] : *node.as_table()) {
                    value.entries.push_back({std::string(key.str()), place_of(key.source()), convert(child)});
                    check_text(value.entries.back().key, value.entries.back().place);
                }
                std::sort(value.entries.begin(), value.entries.end(),
                          [](const Entry& a, const Entry& b) { return before(a.place, b.place); });
                break;
            case toml::node_type::array:
                value.kind = Value::Kind::array;
                for (const toml::node& child : *node.as_array()) value.items.push_back(convert(child));
                break;
            case toml::node_type::string:
                value.kind = Value::Kind::text;
                value.text = node.as_string()->get();
                value.plain_text = stands_as_written(value);
                check_text(value.text, value.place);
                break;
            case toml::node_type::integer:
                value.kind = Value::Kind::integer;
                value.integer = node.as_integer()->get();
                value.number = static_cast<double>(value.integer);
                break;
            case toml::node_type::floating_point:
                value.kind = Value::Kind::number;
                value.number = node.as_floating_point()->get();
                break;
            case toml::node_type::boolean:
                value.kind = Value::Kind::boolean;
                value.boolean = node.as_boolean()->get();
                break;
            default:
                value.kind = Value::Kind::date;
        }
        return value;
    }

 private:
    std::vector<SceneError>& errors_;
    std::vector<std::string_view> lines_;
    struct {
        int line = 0, column = 1;
        std::size_t byte = 0;
    } counted_;  ///< where the last column was found

    void check_text(const std::string& text, const Place& place) {
        for (const char c : text)
            if (static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t' && c != '\r') {
                errors_.push_back({place.line, place.column, place.length,
                                   fmt::format("control character \\u{:04x} in a text", static_cast<int>(c)),
                                   "leave it out"});
                return;
            }
    }

    /// Whether the bytes behind the opening quote are those of the text, so that places inside it can be
    /// shown.
    bool stands_as_written(const Value& value) {
        if (value.place.line < 1 || value.place.line > static_cast<int>(lines_.size())) return false;
        const std::string_view line = lines_[value.place.line - 1];
        // Values come in the order of the file, mostly: going on from the last one keeps long lines cheap.
        if (value.place.line != counted_.line || value.place.column < counted_.column)
            counted_ = {value.place.line, 1, 0};
        std::size_t& at = counted_.byte;
        for (; counted_.column < value.place.column && at < line.size(); ++counted_.column) {
            ++at;
            while (at < line.size() && (line[at] & 0xC0) == 0x80) ++at;
        }
        return at + 1 <= line.size() && line.substr(at + 1, value.text.size()) == value.text &&
               at + 1 + value.text.size() < line.size() && line[at + 1 + value.text.size()] == line[at];
    }
};

/// The parser's words, made shorter; and the place of the token it speaks of, where it stands behind it.
SceneError located(const toml::parse_error& error) {
    SceneError result{static_cast<int>(error.source().begin.line),
                      static_cast<int>(error.source().begin.column), 1,
                      "not TOML: " + std::string(error.description())};
    const std::string said = "Error while parsing ";
    const std::size_t at = result.message.find(said);
    if (at != std::string::npos) result.message.replace(at, said.size(), "in a ");
    if (result.message.find("could not be interpreted") != std::string::npos) {
        const std::size_t open = result.message.find('\''), close = result.message.find('\'', open + 1);
        const std::string token = result.message.substr(open + 1, close - open - 1);
        if (open != std::string::npos && close != std::string::npos && token.size() < 400 &&
            result.column > static_cast<int>(token.size())) {
            result.column -= static_cast<int>(token.size());
            result.length = static_cast<int>(token.size());
            result.message = fmt::format("cannot read \"{}\" as a value", token);
        }
        result.hint = "a number must fit into double precision; a text stands in \"quotes\"";
    } else if (result.message.find("encountered end-of-file") != std::string::npos) {
        result.hint = "something opened before is never closed";
    } else if (result.message.find("cannot redefine") != std::string::npos) {
        result.hint = "the same name stands here twice; a list of bodies is written [[body]]";
    } else if (result.message.find("expected a comment") != std::string::npos ||
               result.message.find("could not determine value type") != std::string::npos) {
        result.hint = "quantities, names and conditions stand in quotes: \"5 m\", \"depth\", \"x < 1 m\"";
    }
    return result;
}

}  // namespace

Value parse_document(const std::string& source, std::vector<SceneError>& errors) {
    if (auto error = prescan(source)) {
        errors.push_back(*error);
        return {};
    }
    try {
        const toml::table table = toml::parse(std::string_view(source), std::string_view());
        return Converter(source, errors).convert(table);
    } catch (const toml::parse_error& error) {
        errors.push_back(located(error));
        return {};
    }
}

}  // namespace hibi
