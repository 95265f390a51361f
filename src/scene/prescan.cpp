#include "scene/prescan.hpp"

#include <fmt/format.h>

namespace hibi {

namespace {

constexpr int deepest_brackets = 32;
constexpr int most_dots = 16;  // of one dotted key

/// Bytes of the UTF-8 character at `at`; 0 where there is none.
int character_bytes(const std::string& s, std::size_t at) {
    const auto byte = [&](std::size_t i) { return i < s.size() ? static_cast<unsigned char>(s[i]) : 0u; };
    const unsigned lead = byte(at);
    if (lead < 0x80) return 1;
    const int bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
    if (lead < 0xC2 || lead > 0xF4) return 0;
    for (int i = 1; i < bytes; ++i)
        if ((byte(at + i) & 0xC0) != 0x80) return 0;
    const unsigned second = byte(at + 1);
    // Overlong forms, surrogates, and beyond U+10FFFF.
    if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
        (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F))
        return 0;
    return bytes;
}

}  // namespace

std::optional<SceneError> prescan(const std::string& source) {
    if (source.size() > largest_scene_bytes)
        return SceneError{0, 0, 1, fmt::format("a scene file of more than {} MB", largest_scene_bytes >> 20),
                          "is this the right file?"};
    int line = 1, column = 1, depth = 0, dots = 0;
    enum class In { plain, comment, text } in = In::plain;
    std::string quote;
    for (std::size_t i = 0; i < source.size();) {
        const char c = source[i];
        int bytes = character_bytes(source, i);
        if (c == '\0' || bytes == 0)
            return SceneError{
                line, column, 1,
                fmt::format("byte 0x{:02x}: this is not a text file", static_cast<unsigned char>(c)),
                "a scene is TOML, a text in UTF-8"};
        switch (in) {
            case In::comment:
                break;
            case In::text:
                if (c == '\\' && quote[0] == '"' && i + 1 < source.size() && source[i + 1] != '\n' &&
                    source[i + 1] != '\0') {
                    // The escaped character may be a quote. What follows a backslash is checked on its own
                    // turn if it is not one of ASCII.
                    if (static_cast<unsigned char>(source[i + 1]) < 0x80) bytes = 2;
                } else if (source.compare(i, quote.size(), quote) == 0) {
                    bytes = static_cast<int>(quote.size());
                    in = In::plain;
                } else if (c == '\n' && quote.size() == 1) {
                    in = In::plain;  // never closed: the parser will say so
                }
                break;
            case In::plain:
                if (c == '#') {
                    in = In::comment;
                } else if (c == '"' || c == '\'') {
                    const bool many = source.compare(i, 3, std::string(3, c)) == 0;
                    quote.assign(many ? 3 : 1, c);
                    bytes = static_cast<int>(quote.size());
                    in = In::text;
                } else if (c == '[' || c == '{') {
                    if (++depth > deepest_brackets)
                        return SceneError{line, column, 1,
                                          fmt::format("brackets nest more than {} deep", deepest_brackets),
                                          "no value of a scene needs more than four"};
                    dots = 0;
                } else if (c == ']' || c == '}') {
                    --depth;
                } else if (c == '.') {
                    if (++dots > most_dots)
                        return SceneError{line, column, 1,
                                          fmt::format("a dotted key of more than {} parts", most_dots),
                                          "tables of a scene are two deep"};
                } else if (c == '=' || c == ',') {
                    dots = 0;
                }
        }
        i += bytes;
        column += static_cast<unsigned char>(c) < 0x80 ? bytes : 1;
        if (c == '\n') {
            ++line;
            column = 1;
            dots = 0;
            if (in == In::comment) in = In::plain;
        }
    }
    return {};
}

}  // namespace hibi
