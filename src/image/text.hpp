#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "image/theme.hpp"

typedef struct _cairo cairo_t;

namespace hibi {

enum class Align { left, centre, right };

struct TextStyle {
    double size = 12;  ///< em (pixels)
    Rgb colour{};
    bool strong = false;   ///< semi-bold
    bool tabular = false;  ///< digits of one width, so that a running number stands still
    Align align = Align::left;
};

/// Sets UTF-8 text in Inter, and in the other fonts built into the program what Inter lacks: in any mixture
/// of scripts and directions, letters joined and stacked as theirs wants. Glyphs are filled as outlines at
/// exact positions: no hinting, no fontconfig, no rounding to whole pixels. Every function throws
/// std::runtime_error for text that is not UTF-8, and MissingGlyph for a character that no font has, naming
/// it. Not thread-safe: glyphs are cached.
class Typesetter {
 public:
    Typesetter();
    ~Typesetter();
    Typesetter(const Typesetter&) = delete;
    Typesetter& operator=(const Typesetter&) = delete;

    double width(const std::string& text, const TextStyle& style) const;  ///< (pixels)
    /// With the baseline at y, and x at the left end, middle or right end.
    void draw(cairo_t* cairo, const std::string& text, double x, double y, const TextStyle& style) const;
    /// The same for whoever paints otherwise: makes the outline of one glyph after another Cairo's current
    /// path and calls paint with the width (pixels) of the stroke that thickens it, mostly 0.
    void outlines(cairo_t* cairo, const std::string& text, double x, double y, const TextStyle& style,
                  const std::function<void(double)>& paint) const;
    /// The text, or as much of its beginning as fits the width together with an ellipsis.
    std::string shortened(const std::string& text, const TextStyle& style, double width) const;
    /// Broken into at most `lines` lines at spaces, or anywhere between characters of Japanese; the last line
    /// is shortened where the text is longer.
    std::vector<std::string> wrapped(const std::string& text, const TextStyle& style, double width,
                                     int lines) const;

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Throws as Typesetter does where the text cannot be set: lets a scene be refused before it is simulated.
void require_glyphs(const std::string& text);

/// The text with a box in place of whatever cannot be set: for words that nobody can be asked to change, such
/// as a message that names a file.
std::string with_boxes(const std::string& text);

}  // namespace hibi
