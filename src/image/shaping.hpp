#pragma once
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "image/fonts.hpp"

namespace hibi {

/// No built-in font has a character.
struct MissingGlyph : std::runtime_error {
    MissingGlyph(char32_t missing, std::size_t index);
    std::size_t at;  ///< its index among the characters of the text
};

/// Whether the character stands by itself, from left to right: then no shaping is needed, a font that has it
/// given.
bool stands_by_itself(char32_t point);
/// Whether the character belongs to the one before: an accent, a vowel sign, a joiner, the end of a Korean
/// syllable.
bool continues_cluster(char32_t point);

/// A part of a text in one font and one direction.
struct TextRun {
    std::size_t begin = 0, end = 0;  ///< characters
    int font = 0;
    bool from_right = false;
    bool plain = false;  ///< from the left, of characters that stand by themselves in Inter or IPAex Gothic
};

/// The runs in the order in which they stand in the line, from the left. The direction of the whole is that
/// of its first letter (Unicode Bidirectional Algorithm, UAX 9). Throws MissingGlyph.
std::vector<TextRun> split_into_runs(const Fonts& fonts, std::u32string_view text, bool strong);

/// A glyph with its origin, from that of the run (em, y downward).
struct ShapedGlyph {
    const Glyph* glyph = nullptr;
    double x = 0, y = 0;
};
struct ShapedRun {
    std::vector<ShapedGlyph> glyphs;
    double advance = 0;  ///< (em)
};
/// The glyphs of a run, joined, stacked and ordered as its script wants. The text around it counts too.
ShapedRun shape(const Fonts& fonts, std::u32string_view text, const TextRun& run);

}  // namespace hibi
