#include "image/text.hpp"

#include <cairo.h>

#include <algorithm>
#include <map>
#include <span>
#include <stdexcept>

#include "image/fonts.hpp"
#include "image/shaping.hpp"
#include "image/utf8.hpp"

namespace hibi {

namespace {

/// Kana, ideographs and their punctuation: a line may break on either side.
bool breaks_anywhere(char32_t p) { return p >= 0x2e80 && p < 0xa000; }

constexpr char32_t ellipsis = 0x2026;

}  // namespace

struct Typesetter::Impl {
    Fonts fonts;
    std::map<char32_t, const Glyph*> plain_glyphs[2];  // regular, semi-bold
    double digit_width[2] = {0, 0};                    // em

    Impl() {
        for (const bool strong : {false, true})
            for (char32_t d = '0'; d <= '9'; ++d)
                digit_width[strong] = std::max(digit_width[strong], plain_glyph(d, strong)->advance);
    }

    /// Of a character that stands by itself and that Inter or IPAex Gothic has; null for others.
    const Glyph* plain_glyph(char32_t point, bool strong) {
        const auto [found, is_new] = plain_glyphs[strong].try_emplace(point, nullptr);
        if (!is_new || point < 0x20 || !stands_by_itself(point)) return found->second;
        for (const int font : {strong ? Fonts::inter_semibold : Fonts::inter, Fonts::ipaex})
            if (const unsigned index = fonts.index(font, point); index && !found->second)
                found->second = &fonts.glyph(font, index);
        return found->second;
    }

    /// Calls place(glyphs) for every part of the text that is painted at once, positions in pixels from its
    /// left end; returns the width. Characters that stand by themselves follow each other by their own
    /// widths, without kerning; all others are shaped.
    template <class Place>
    double walk(std::u32string_view points, const TextStyle& style, Place&& place) {
        double x = 0;
        const auto walk_plain = [&](std::u32string_view part) {
            for (const char32_t p : part) {
                const Glyph& g = *plain_glyph(p, style.strong);
                const bool fixed = style.tabular && p >= '0' && p <= '9';
                const double advance = fixed ? digit_width[style.strong] : g.advance;
                const ShapedGlyph placed{&g, x + style.size * (advance - g.advance) / 2, 0};
                place(std::span(&placed, 1));
                x += style.size * advance;
            }
        };
        if (std::ranges::all_of(points, [&](char32_t p) { return plain_glyph(p, style.strong); })) {
            walk_plain(points);
            return x;
        }
        for (const TextRun& run : split_into_runs(fonts, points, style.strong)) {
            if (run.plain) {
                walk_plain(points.substr(run.begin, run.end - run.begin));
                continue;
            }
            ShapedRun shaped = shape(fonts, points, run);
            for (ShapedGlyph& g : shaped.glyphs) g.x = x + style.size * g.x, g.y *= style.size;
            place(std::span<const ShapedGlyph>(shaped.glyphs));
            x += style.size * shaped.advance;
        }
        return x;
    }

    double width(std::u32string_view points, const TextStyle& style) {
        return walk(points, style, [](std::span<const ShapedGlyph>) {});
    }

    std::u32string shortened(std::u32string points, const TextStyle& style, double limit) {
        if (width(points, style) <= limit) return points;
        while (!points.empty()) {
            while (points.size() > 1 && continues_cluster(points.back())) points.pop_back();
            points.pop_back();
            while (!points.empty() && points.back() == ' ') points.pop_back();
            if (width(points + ellipsis, style) <= limit) return points + ellipsis;
        }
        return points;
    }
};

Typesetter::Typesetter() : impl_(std::make_unique<Impl>()) {}
Typesetter::~Typesetter() = default;

double Typesetter::width(const std::string& text, const TextStyle& style) const {
    return impl_->width(decode_utf8(text), style);
}

void Typesetter::draw(cairo_t* cairo, const std::string& text, double x, double y,
                      const TextStyle& style) const {
    cairo_set_source_rgb(cairo, style.colour[0], style.colour[1], style.colour[2]);
    outlines(cairo, text, x, y, style, [&](double thicker) {
        if (thicker > 0) {
            cairo_set_line_width(cairo, thicker);
            cairo_stroke_preserve(cairo);
        }
        cairo_fill(cairo);
    });
}

void Typesetter::outlines(cairo_t* cairo, const std::string& text, double x, double y, const TextStyle& style,
                          const std::function<void(double)>& paint) const {
    const std::u32string points = decode_utf8(text);
    if (style.align != Align::left)
        x -= impl_->width(points, style) * (style.align == Align::right ? 1 : 0.5);
    impl_->walk(points, style, [&](std::span<const ShapedGlyph> part) {
        cairo_new_path(cairo);  // one path, so that letters that join show no seam
        bool substitute = false;
        for (const auto& [glyph, at, down] : part) {
            int next = 0;
            const auto px = [&](int i) { return x + at + style.size * glyph->points[next + i][0]; };
            const auto py = [&](int i) { return y + down + style.size * glyph->points[next + i][1]; };
            for (const Glyph::Step step : glyph->steps) {
                if (step == Glyph::move) cairo_move_to(cairo, px(0), py(0));
                if (step == Glyph::line) cairo_line_to(cairo, px(0), py(0));
                if (step == Glyph::curve) cairo_curve_to(cairo, px(0), py(0), px(1), py(1), px(2), py(2));
                next += step == Glyph::curve ? 3 : 1;
            }
            substitute = substitute || glyph->substitute;
        }
        // A substitute has one weight only: thickened it stands beside Inter's semi-bold.
        paint(substitute && style.strong ? 0.035 * style.size : 0);
    });
}

std::string Typesetter::shortened(const std::string& text, const TextStyle& style, double width) const {
    return encode_utf8(impl_->shortened(decode_utf8(text), style, width));
}

std::vector<std::string> Typesetter::wrapped(const std::string& text, const TextStyle& style, double width,
                                             int lines) const {
    std::vector<std::string> result;
    std::u32string rest = decode_utf8(text);
    while (!rest.empty()) {
        if (static_cast<int>(result.size()) == lines - 1 || impl_->width(rest, style) <= width) {
            result.push_back(encode_utf8(impl_->shortened(rest, style, width)));
            break;
        }
        std::size_t cut = 0;  // the last place to break at that still fits
        for (std::size_t i = 1; i < rest.size(); ++i) {
            if (impl_->width(std::u32string_view(rest).substr(0, i), style) > width) break;
            if (continues_cluster(rest[i])) continue;
            if (rest[i] == ' ' || breaks_anywhere(rest[i]) || breaks_anywhere(rest[i - 1])) cut = i;
        }
        if (cut == 0) {  // one word wider than the line
            result.push_back(encode_utf8(impl_->shortened(rest, style, width)));
            break;
        }
        result.push_back(encode_utf8(std::u32string_view(rest).substr(0, cut)));
        rest.erase(0, rest[cut] == ' ' ? cut + 1 : cut);
    }
    return result;
}

void require_glyphs(const std::string& text) {
    if (std::ranges::any_of(text, [](char c) { return c < ' ' || c > '~'; })) Typesetter().width(text, {});
}

std::string with_boxes(const std::string& text) {
    constexpr char32_t box = 0x25a1;
    std::u32string points;
    try {
        points = decode_utf8(text);
    } catch (const std::runtime_error&) {  // a name of a file may be any bytes
        for (const char c : text)
            points += static_cast<unsigned char>(c) < 0x80 ? static_cast<char32_t>(c) : box;
    }
    for (char32_t& p : points)
        if (p < ' ') p = ' ';
    const Fonts fonts;
    for (;;) try {
            split_into_runs(fonts, points, false);
            return encode_utf8(points);
        } catch (const MissingGlyph& missing) {
            points[missing.at] = box;
        }
}

}  // namespace hibi
