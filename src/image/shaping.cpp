#include "image/shaping.hpp"

#include <fmt/format.h>
#include <fribidi.h>
#include <hb.h>

#include <algorithm>
#include <memory>

#include "image/utf8.hpp"

namespace hibi {

namespace {

using Buffer = std::unique_ptr<hb_buffer_t, decltype(&hb_buffer_destroy)>;

hb_unicode_general_category_t category(char32_t p) {
    return hb_unicode_general_category(hb_unicode_funcs_get_default(), p);
}
hb_script_t script(char32_t p) { return hb_unicode_script(hb_unicode_funcs_get_default(), p); }

bool is_format(char32_t p) { return category(p) == HB_UNICODE_GENERAL_CATEGORY_FORMAT; }

/// Letters that run from right to left, numbers among them, and characters that turn the direction.
bool turns_direction(char32_t p) {
    const FriBidiCharType type = fribidi_get_bidi_type(p);
    return FRIBIDI_IS_RTL(type) || FRIBIDI_IS_ARABIC(type) || FRIBIDI_IS_EXPLICIT_OR_BN(type) ||
           FRIBIDI_IS_ISOLATE(type);
}

/// Levels of UAX 9 for each character: odd ones run from the right.
std::vector<FriBidiLevel> bidi_levels(std::u32string_view text) {
    std::vector<FriBidiLevel> levels(text.size(), 0);
    if (std::ranges::none_of(text, turns_direction)) return levels;
    const auto count = static_cast<FriBidiStrIndex>(text.size());
    const std::vector<FriBidiChar> points(text.begin(), text.end());
    std::vector<FriBidiCharType> types(text.size());
    std::vector<FriBidiBracketType> brackets(text.size());
    fribidi_get_bidi_types(points.data(), count, types.data());
    fribidi_get_bracket_types(points.data(), count, types.data(), brackets.data());
    FriBidiParType direction = FRIBIDI_PAR_ON;
    if (!fribidi_get_par_embedding_levels_ex(types.data(), brackets.data(), count, &direction, levels.data()))
        throw std::bad_alloc();
    return levels;
}

/// HarfBuzz's answer for part of a text.
Buffer shaped(const Fonts& fonts, std::u32string_view text, const TextRun& run) {
    Buffer buffer(hb_buffer_create(), hb_buffer_destroy);
    const std::vector<std::uint32_t> points(text.begin(), text.end());
    hb_buffer_add_utf32(buffer.get(), points.data(), static_cast<int>(points.size()),
                        static_cast<unsigned>(run.begin), static_cast<int>(run.end - run.begin));
    hb_buffer_set_direction(buffer.get(), run.from_right ? HB_DIRECTION_RTL : HB_DIRECTION_LTR);
    // Not guessed by HarfBuzz, which would ask the machine for its language.
    hb_script_t own = HB_SCRIPT_COMMON;
    for (std::size_t i = run.begin; i < run.end; ++i)
        if (const hb_script_t s = script(text[i]); s != HB_SCRIPT_COMMON && s != HB_SCRIPT_INHERITED) {
            own = s;
            break;
        }
    hb_buffer_set_script(buffer.get(), own);
    hb_shape(fonts.shaper(run.font), buffer.get(), nullptr, 0);
    return buffer;
}

/// Has the font all of a cluster? Several characters may make one glyph.
bool has_cluster(const Fonts& fonts, int font, std::u32string_view cluster) {
    if (cluster.size() == 1) return fonts.index(font, cluster[0]) != 0;
    const Buffer buffer = shaped(fonts, cluster, {0, cluster.size(), font, false, false});
    unsigned count = 0;
    const hb_glyph_info_t* const glyphs = hb_buffer_get_glyph_infos(buffer.get(), &count);
    return std::all_of(glyphs, glyphs + count, [](const hb_glyph_info_t& g) { return g.codepoint != 0; });
}

/// The fonts in the order in which they are asked. Chinese and Japanese share characters, but not their
/// shapes: where IPAex Gothic lacks one, the whole text is set in the Chinese font.
std::vector<int> order_of_fonts(const Fonts& fonts, std::u32string_view text, bool strong) {
    std::vector<int> order{strong ? Fonts::inter_semibold : Fonts::inter};
    for (int font = Fonts::ipaex; font < fonts.count(); ++font) order.push_back(font);
    const bool chinese = std::ranges::any_of(text, [&](char32_t p) {
        return script(p) == HB_SCRIPT_HAN && !fonts.index(Fonts::ipaex, p) && fonts.index(Fonts::droid, p);
    });
    if (chinese) std::swap(order[1], order[2]);
    return order;
}

/// The font of each character; a cluster has one.
std::vector<int> fonts_of(const Fonts& fonts, std::u32string_view text, bool strong) {
    const std::vector<int> order = order_of_fonts(fonts, text, strong);
    std::vector<int> chosen(text.size(), order[0]);
    for (std::size_t begin = 0, end; begin < text.size(); begin = end) {
        for (end = begin + 1; end < text.size() && continues_cluster(text[end]);) ++end;
        const std::u32string_view cluster = text.substr(begin, end - begin);
        const auto font = std::ranges::find_if(order, [&](int f) { return has_cluster(fonts, f, cluster); });
        int its = begin > 0 ? chosen[begin - 1] : order[0];
        if (font != order.end() && cluster[0] >= 0x20)
            its = *font;
        else if (!is_format(cluster[0]))  // those are seen by nobody and need no glyph
            throw MissingGlyph(cluster[0], begin);
        std::fill(chosen.begin() + static_cast<long>(begin), chosen.begin() + static_cast<long>(end), its);
    }
    return chosen;
}

}  // namespace

MissingGlyph::MissingGlyph(char32_t missing, std::size_t index)
    : std::runtime_error(fmt::format("no built-in font has \"{}\" (U+{:04X})",
                                     missing < 0x20 ? "" : encode_utf8({&missing, 1}),
                                     static_cast<unsigned>(missing))),
      at(index) {}

bool continues_cluster(char32_t p) {
    const hb_unicode_general_category_t c = category(p);
    constexpr char32_t non_joiner = 0x200c, joiner = 0x200d, first_vowel = 0x1160, last_final = 0x11ff;
    return c == HB_UNICODE_GENERAL_CATEGORY_NON_SPACING_MARK ||
           c == HB_UNICODE_GENERAL_CATEGORY_SPACING_MARK || c == HB_UNICODE_GENERAL_CATEGORY_ENCLOSING_MARK ||
           p == non_joiner || p == joiner || (p >= first_vowel && p <= last_final);
}

bool stands_by_itself(char32_t p) {
    if (p < 0x300) return true;
    return !continues_cluster(p) && !is_format(p) && !turns_direction(p);
}

std::vector<TextRun> split_into_runs(const Fonts& fonts, std::u32string_view text, bool strong) {
    const std::vector<int> font = fonts_of(fonts, text, strong);
    const std::vector<FriBidiLevel> level = bidi_levels(text);
    std::vector<TextRun> runs;
    std::vector<FriBidiLevel> level_of_run;
    const auto plain = [&](std::size_t i) {
        return font[i] <= Fonts::ipaex && level[i] % 2 == 0 && stands_by_itself(text[i]) &&
               (i + 1 == text.size() || !continues_cluster(text[i + 1]));
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (runs.empty() || runs.back().font != font[i] || level_of_run.back() != level[i] ||
            runs.back().plain != plain(i)) {
            runs.push_back({i, i, font[i], level[i] % 2 != 0, plain(i)});
            level_of_run.push_back(level[i]);
        }
        runs.back().end = i + 1;
    }
    // Rule L2: from the highest level to the lowest odd one, whatever is at least as high is turned round.
    const FriBidiLevel highest = runs.empty() ? FriBidiLevel(0) : *std::ranges::max_element(level_of_run);
    for (FriBidiLevel turned = highest; turned > 0; --turned)
        for (std::size_t begin = 0; begin < runs.size(); ++begin) {
            std::size_t end = begin;
            while (end < runs.size() && level_of_run[end] >= turned) ++end;
            std::reverse(runs.begin() + static_cast<long>(begin), runs.begin() + static_cast<long>(end));
            std::reverse(level_of_run.begin() + static_cast<long>(begin),
                         level_of_run.begin() + static_cast<long>(end));
            begin = end;
        }
    return runs;
}

ShapedRun shape(const Fonts& fonts, std::u32string_view text, const TextRun& run) {
    const Buffer buffer = shaped(fonts, text, run);
    unsigned count = 0;
    const hb_glyph_info_t* const glyphs = hb_buffer_get_glyph_infos(buffer.get(), &count);
    const hb_glyph_position_t* const places = hb_buffer_get_glyph_positions(buffer.get(), &count);
    const double em = fonts.units_per_em(run.font);
    ShapedRun result;
    for (unsigned k = 0; k < count; ++k) {
        result.glyphs.push_back({&fonts.glyph(run.font, glyphs[k].codepoint),
                                 result.advance + places[k].x_offset / em, -places[k].y_offset / em});
        result.advance += places[k].x_advance / em;
    }
    return result;
}

}  // namespace hibi
