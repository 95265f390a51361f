#include "image/text.hpp"

#include <cairo.h>
#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <stdexcept>

#include "image/font_data.hpp"

namespace hibi {

namespace {

/// Code points of UTF-8 text. Overlong forms, surrogates and stray bytes are refused.
std::u32string decode(const std::string& text) {
    std::u32string points;
    for (std::size_t i = 0; i < text.size();) {
        const unsigned char lead = static_cast<unsigned char>(text[i]);
        const int more = lead < 0x80   ? 0
                         : lead < 0xc2 ? -1
                         : lead < 0xe0 ? 1
                         : lead < 0xf0 ? 2
                         : lead < 0xf5 ? 3
                                       : -1;
        char32_t point = more <= 0 ? lead : lead & (0x3f >> more);
        bool good = more >= 0 && i + more < text.size();
        for (int k = 1; good && k <= more; ++k) {
            const unsigned char byte = static_cast<unsigned char>(text[i + k]);
            good = (byte & 0xc0) == 0x80;
            point = point << 6 | (byte & 0x3f);
        }
        const char32_t smallest = more == 3 ? 0x10000 : more == 2 ? 0x800 : 0;
        if (!good || point < smallest || point > 0x10ffff || (point >= 0xd800 && point < 0xe000))
            throw std::runtime_error(fmt::format("text is not UTF-8 at byte {}", i + 1));
        points += point;
        i += 1 + more;
    }
    return points;
}

std::string encode(std::u32string_view points) {
    std::string text;
    for (const char32_t p : points) {
        const auto add = [&](char32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
        if (p < 0x80) {
            add(p);
        } else if (p < 0x800) {
            add(0xc0 | p >> 6), add(0x80 | (p & 0x3f));
        } else if (p < 0x10000) {
            add(0xe0 | p >> 12), add(0x80 | (p >> 6 & 0x3f)), add(0x80 | (p & 0x3f));
        } else {
            add(0xf0 | p >> 18), add(0x80 | (p >> 12 & 0x3f)), add(0x80 | (p >> 6 & 0x3f)),
                add(0x80 | (p & 0x3f));
        }
    }
    return text;
}

/// Kana, ideographs and their punctuation: a line may break on either side.
bool breaks_anywhere(char32_t p) { return p >= 0x2e80 && p < 0xa000; }

/// An outline in units of the em, y downward, as Cairo draws it. One number of points per kind of step.
struct Glyph {
    enum Step : std::uint8_t { move, line, curve };
    std::vector<Step> steps;
    std::vector<std::array<double, 2>> points;
    double advance = 0;       ///< to the next glyph (em)
    bool substitute = false;  ///< from the font that has no semi-bold
};

struct OutlineSink {
    Glyph& glyph;
    double scale;
    std::array<double, 2> at{};

    std::array<double, 2> point(const FT_Vector* v) const {
        return {scale * static_cast<double>(v->x), -scale * static_cast<double>(v->y)};
    }
    void add(Glyph::Step step, std::initializer_list<std::array<double, 2>> points) {
        glyph.steps.push_back(step);
        glyph.points.insert(glyph.points.end(), points);
        at = *(points.end() - 1);
    }
    static OutlineSink& of(void* user) { return *static_cast<OutlineSink*>(user); }
    static int move_to(const FT_Vector* to, void* user) {
        return of(user).add(Glyph::move, {of(user).point(to)}), 0;
    }
    static int line_to(const FT_Vector* to, void* user) {
        return of(user).add(Glyph::line, {of(user).point(to)}), 0;
    }
    static int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
        // The same parabola as a cubic: its control points lie two thirds of the way to the quadratic one.
        const auto a = of(user).at, c = of(user).point(control), b = of(user).point(to);
        const auto mix = [](double p, double q) { return p + 2 * (q - p) / 3; };
        of(user).add(Glyph::curve,
                     {{mix(a[0], c[0]), mix(a[1], c[1])}, {mix(b[0], c[0]), mix(b[1], c[1])}, {b[0], b[1]}});
        return 0;
    }
    static int cubic_to(const FT_Vector* c1, const FT_Vector* c2, const FT_Vector* to, void* user) {
        const OutlineSink& sink = of(user);
        return of(user).add(Glyph::curve, {sink.point(c1), sink.point(c2), sink.point(to)}), 0;
    }
};

void check(FT_Error error, const char* what) {
    if (error) throw std::runtime_error(fmt::format("FreeType: {} failed (error {})", what, error));
}

constexpr char32_t ellipsis = 0x2026;

}  // namespace

struct Typesetter::Impl {
    FT_Library library = nullptr;
    FT_Face regular = nullptr, semibold = nullptr, japanese = nullptr;
    std::map<char32_t, Glyph> glyphs[2];  // regular, semi-bold
    double digit_width[2] = {0, 0};       // em

    Impl() {
        check(FT_Init_FreeType(&library), "start");
        const auto open = [&](std::span<const unsigned char> bytes, FT_Face* face) {
            check(FT_New_Memory_Face(library, bytes.data(), static_cast<FT_Long>(bytes.size()), 0, face),
                  "opening a built-in font");
        };
        open(inter_regular(), &regular);
        open(inter_semibold(), &semibold);
        open(ipaex_gothic(), &japanese);
        for (const bool strong : {false, true})
            for (char32_t d = '0'; d <= '9'; ++d)
                digit_width[strong] = std::max(digit_width[strong], glyph(d, strong).advance);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() { FT_Done_FreeType(library); }  // and its faces

    const Glyph& glyph(char32_t point, bool strong) {
        const auto [found, is_new] = glyphs[strong].try_emplace(point);
        if (!is_new) return found->second;
        FT_Face face = strong ? semibold : regular;
        FT_UInt index = FT_Get_Char_Index(face, point);
        if (index == 0) {
            face = japanese;
            index = FT_Get_Char_Index(face, point);
        }
        if (index == 0 || point < 0x20) {
            glyphs[strong].erase(found);
            throw std::runtime_error(fmt::format("no glyph for \"{}\" (U+{:04X}) in Inter or IPAex Gothic",
                                                 point < 0x20 ? "" : encode({&point, 1}),
                                                 static_cast<unsigned>(point)));
        }
        check(FT_Load_Glyph(face, index, FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP),
              "loading a glyph");
        Glyph& glyph = found->second;
        const double scale = 1.0 / face->units_per_EM;
        glyph.advance = scale * static_cast<double>(face->glyph->metrics.horiAdvance);
        glyph.substitute = face == japanese;
        OutlineSink sink{glyph, scale};
        const FT_Outline_Funcs steps = {
            OutlineSink::move_to, OutlineSink::line_to, OutlineSink::conic_to, OutlineSink::cubic_to, 0, 0};
        check(FT_Outline_Decompose(&face->glyph->outline, &steps, &sink), "reading an outline");
        return glyph;
    }

    /// Calls place(glyph, x) for every character, x in pixels from the left end; returns the width.
    template <class Place>
    double walk(std::u32string_view points, const TextStyle& style, Place&& place) {
        double x = 0;
        for (const char32_t p : points) {
            const Glyph& g = glyph(p, style.strong);
            const bool fixed = style.tabular && p >= '0' && p <= '9';
            const double advance = fixed ? digit_width[style.strong] : g.advance;
            place(g, x + style.size * (advance - g.advance) / 2);
            x += style.size * advance;
        }
        return x;
    }

    double width(std::u32string_view points, const TextStyle& style) {
        return walk(points, style, [](const Glyph&, double) {});
    }

    std::u32string shortened(std::u32string points, const TextStyle& style, double limit) {
        if (width(points, style) <= limit) return points;
        while (!points.empty()) {
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
    return impl_->width(decode(text), style);
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
    const std::u32string points = decode(text);
    if (style.align != Align::left)
        x -= impl_->width(points, style) * (style.align == Align::right ? 1 : 0.5);
    impl_->walk(points, style, [&](const Glyph& glyph, double at) {
        int next = 0;
        const auto px = [&](int i) { return x + at + style.size * glyph.points[next + i][0]; };
        const auto py = [&](int i) { return y + style.size * glyph.points[next + i][1]; };
        cairo_new_path(cairo);
        for (const Glyph::Step step : glyph.steps) {
            if (step == Glyph::move) cairo_move_to(cairo, px(0), py(0));
            if (step == Glyph::line) cairo_line_to(cairo, px(0), py(0));
            if (step == Glyph::curve) cairo_curve_to(cairo, px(0), py(0), px(1), py(1), px(2), py(2));
            next += step == Glyph::curve ? 3 : 1;
        }
        // The substitute has one weight only: thickened it stands beside Inter's semi-bold.
        paint(glyph.substitute && style.strong ? 0.035 * style.size : 0);
    });
}

std::string Typesetter::shortened(const std::string& text, const TextStyle& style, double width) const {
    return encode(impl_->shortened(decode(text), style, width));
}

std::vector<std::string> Typesetter::wrapped(const std::string& text, const TextStyle& style, double width,
                                             int lines) const {
    std::vector<std::string> result;
    std::u32string rest = decode(text);
    while (!rest.empty()) {
        if (static_cast<int>(result.size()) == lines - 1 || impl_->width(rest, style) <= width) {
            result.push_back(encode(impl_->shortened(rest, style, width)));
            break;
        }
        std::size_t cut = 0;  // the last place to break at that still fits
        for (std::size_t i = 1; i < rest.size(); ++i) {
            if (impl_->width(std::u32string_view(rest).substr(0, i), style) > width) break;
            if (rest[i] == ' ' || breaks_anywhere(rest[i]) || breaks_anywhere(rest[i - 1])) cut = i;
        }
        if (cut == 0) {  // one word wider than the line
            result.push_back(encode(impl_->shortened(rest, style, width)));
            break;
        }
        result.push_back(encode(std::u32string_view(rest).substr(0, cut)));
        rest.erase(0, rest[cut] == ' ' ? cut + 1 : cut);
    }
    return result;
}

void require_glyphs(const std::string& text) { Typesetter().width(text, {}); }

}  // namespace hibi
