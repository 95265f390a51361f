#include <fmt/format.h>

#include <algorithm>

#include "scene/read.hpp"

namespace hibi {

namespace {

constexpr int widest_excerpt = 160;  // characters of a line that are shown
constexpr int most_errors = 50;      // shown; the rest is counted

/// The characters of a line, one string each; what a terminal would not print as one cell becomes one that it
/// does.
std::vector<std::string> characters(const std::string& source, int wanted_line) {
    std::vector<std::string> result;
    std::size_t at = 0;
    for (int line = 1; line < wanted_line; ++line) {
        at = source.find('\n', at);
        if (at == std::string::npos) return result;
        ++at;
    }
    for (; at < source.size() && source[at] != '\n'; ++at) {
        const auto byte = static_cast<unsigned char>(source[at]);
        if ((byte & 0xC0) == 0x80 && !result.empty())
            result.back() += source[at];
        else
            result.emplace_back(1, byte == '\t'               ? ' '
                                   : byte == '\r'             ? ' '
                                   : byte < 32 || byte == 127 ? '?'
                                                              : source[at]);
        if (result.size() > 200000) break;
    }
    return result;
}

bool is_utf8(const std::string& character) {
    const auto lead = static_cast<unsigned char>(character[0]);
    return lead < 0x80 || character.size() == (lead >= 0xF0 ? 4u : lead >= 0xE0 ? 3u : 2u);
}

/// Letters of Chinese, Japanese and Korean texts take two cells of a terminal.
int cells(const std::string& character) { return character.size() >= 3 ? 2 : 1; }

std::string excerpt(const SceneError& error, const std::string& source) {
    const std::vector<std::string> line = characters(source, error.line);
    const int size = static_cast<int>(line.size());
    const int column = std::clamp(error.column, 1, size + 1);
    const int first = column > widest_excerpt - 20 ? column - 20 : 1;
    const int last = std::min(size, first + widest_excerpt - 1);
    std::string shown = first > 1 ? "..." : "", marks(shown.size(), ' ');
    for (int c = first; c <= last; ++c) {
        const std::string& character = line[c - 1];
        shown += is_utf8(character) ? character : "?";
        if (c < column) marks.append(is_utf8(character) ? cells(character) : 1, ' ');
        if (c >= column && c < column + error.length) marks.append(cells(character), '^');
    }
    if (last < size) shown += "...";
    if (marks.find('^') == std::string::npos) marks += '^';
    while (!shown.empty() && shown.back() == ' ') shown.pop_back();
    return fmt::format("\n{:>5} | {}\n      | {}{}{}", error.line, shown, marks,
                       error.hint.empty() ? "" : " ", error.hint);
}

std::string report(const std::string& file, const std::string& source,
                   const std::vector<SceneError>& errors) {
    std::string text;
    int shown = 0;
    for (const SceneError& error : errors) {
        if (!text.empty()) text += '\n';
        if (++shown > most_errors) {
            text += fmt::format("{}: and {} more", file, errors.size() - most_errors);
            break;
        }
        if (error.line > 0) {
            text += fmt::format("{}:{}:{}: error: {}", file, error.line, error.column, error.message);
            text += excerpt(error, source);
        } else {
            text += fmt::format("{}: error: {}{}{}", file, error.message, error.hint.empty() ? "" : "; ",
                                error.hint);
        }
    }
    return text;
}

std::vector<SceneError> sorted(std::vector<SceneError> errors) {
    std::stable_sort(errors.begin(), errors.end(), [](const SceneError& a, const SceneError& b) {
        return a.line != b.line ? a.line < b.line : a.column < b.column;
    });
    return errors;
}

}  // namespace

SceneErrors::SceneErrors(const std::string& file, const std::string& source, std::vector<SceneError> errors)
    : std::runtime_error(report(file, source, sorted(errors))), errors_(sorted(std::move(errors))) {}

}  // namespace hibi
