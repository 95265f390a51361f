#include "image/fonts.hpp"

#include <fmt/format.h>
#include <ft2build.h>
#include <hb-ot.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <stdexcept>

#include "image/font_data.hpp"

namespace hibi {

namespace {

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

struct Face {
    FT_Face outlines = nullptr;
    std::unique_ptr<hb_font_t, decltype(&hb_font_destroy)> shaper{nullptr, hb_font_destroy};
};

}  // namespace

struct Fonts::Impl {
    FT_Library library = nullptr;
    std::vector<Face> faces = std::vector<Face>(built_in_fonts().size());
    std::map<std::pair<int, unsigned>, Glyph> glyphs;

    Impl() { check(FT_Init_FreeType(&library), "start"); }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;
    ~Impl() { FT_Done_FreeType(library); }  // and its faces

    FT_Face face(int font) {
        FT_Face& face = faces[font].outlines;
        const std::span<const unsigned char> bytes = built_in_fonts()[font].bytes;
        if (!face)
            check(FT_New_Memory_Face(library, bytes.data(), static_cast<FT_Long>(bytes.size()), 0, &face),
                  "opening a built-in font");
        return face;
    }

    hb_font_t* shaper(int font) {
        auto& shaper = faces[font].shaper;
        if (shaper) return shaper.get();
        const std::span<const unsigned char> bytes = built_in_fonts()[font].bytes;
        hb_blob_t* const blob =
            hb_blob_create(reinterpret_cast<const char*>(bytes.data()), static_cast<unsigned>(bytes.size()),
                           HB_MEMORY_MODE_READONLY, nullptr, nullptr);
        hb_face_t* const face = hb_face_create(blob, 0);
        shaper.reset(hb_font_create(face));
        hb_face_destroy(face);
        hb_blob_destroy(blob);
        return shaper.get();
    }

    const Glyph& glyph(int font, unsigned index) {
        const auto found = glyphs.find({font, index});
        if (found != glyphs.end()) return found->second;
        FT_Face from = face(font);
        check(FT_Load_Glyph(from, index, FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP),
              "loading a glyph");
        Glyph glyph;
        const double scale = 1.0 / from->units_per_EM;
        glyph.advance = scale * static_cast<double>(from->glyph->metrics.horiAdvance);
        glyph.substitute = font >= ipaex;
        OutlineSink sink{glyph, scale};
        const FT_Outline_Funcs steps = {
            OutlineSink::move_to, OutlineSink::line_to, OutlineSink::conic_to, OutlineSink::cubic_to, 0, 0};
        check(FT_Outline_Decompose(&from->glyph->outline, &steps, &sink), "reading an outline");
        return glyphs.emplace(std::pair(font, index), std::move(glyph)).first->second;
    }
};

Fonts::Fonts() : impl_(std::make_unique<Impl>()) {}
Fonts::~Fonts() = default;

int Fonts::count() const { return static_cast<int>(built_in_fonts().size()); }
unsigned Fonts::index(int font, char32_t point) const { return FT_Get_Char_Index(impl_->face(font), point); }
const Glyph& Fonts::glyph(int font, unsigned index) const { return impl_->glyph(font, index); }
hb_font_t* Fonts::shaper(int font) const { return impl_->shaper(font); }
double Fonts::units_per_em(int font) const { return impl_->face(font)->units_per_EM; }

}  // namespace hibi
