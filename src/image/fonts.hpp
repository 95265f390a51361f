#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

typedef struct hb_font_t hb_font_t;

namespace hibi {

/// An outline in units of the em, y downward, as Cairo draws it. One number of points per kind of step.
struct Glyph {
    enum Step : std::uint8_t { move, line, curve };
    std::vector<Step> steps;
    std::vector<std::array<double, 2>> points;
    double advance = 0;       ///< to the next glyph (em)
    bool substitute = false;  ///< from a font that has no semi-bold
};

/// The fonts built into the program, by their number in built_in_fonts(). Each is opened when it is first
/// asked for. Not thread-safe.
class Fonts {
 public:
    static constexpr int inter = 0, inter_semibold = 1, ipaex = 2, droid = 3;

    Fonts();
    ~Fonts();
    int count() const;
    /// Number of the glyph in that font; 0 where it has none for this character.
    unsigned index(int font, char32_t point) const;
    const Glyph& glyph(int font, unsigned index) const;
    /// For HarfBuzz; positions come in 1/units_per_em(font) of the em.
    hb_font_t* shaper(int font) const;
    double units_per_em(int font) const;

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hibi
