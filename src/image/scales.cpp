#include "image/scales.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/units.hpp"
#include "image/axis.hpp"
#include "image/canvas.hpp"
#include "image/text.hpp"

namespace hibi {

namespace {

constexpr double bar_share = 0.58, scale_bar_share = 0.2;  // of the width

void draw_colours(cairo_t* cairo, const ColourBar& bar, const PixelRect& r, const Theme& colours,
                  const Typesetter& type, double text, double line) {
    const Scale scale = scale_for(std::max(std::abs(bar.low), std::abs(bar.high)), bar.unit);
    TextStyle style{.size = text, .colour = colours.text, .tabular = true};
    type.draw(cairo, with_unit(bar.title, scale), r.x, r.y + text, style);
    const int left = static_cast<int>(r.x), right = static_cast<int>(r.x + r.width);
    const double top = std::round(r.y + 1.6 * text), foot = std::round(top + text);
    const ColourMap& map = colour_map(bar.map);
    for (int x = left; x < right; ++x) {
        const auto& c = map[std::clamp(static_cast<int>(256 * (x + 0.5 - left) / (right - left)), 0, 255)];
        cairo_set_source_rgb(cairo, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
        cairo_rectangle(cairo, x, top, 1, foot - top);
        cairo_fill(cairo);
    }
    const double low = bar.low * scale.factor, high = bar.high * scale.factor;
    const Ticks ticks = round_ticks(low, high, std::max(2, static_cast<int>(r.width / (3.3 * text))));
    style.align = Align::centre;
    cairo_set_line_width(cairo, line);
    for (const double tick : ticks.at) {
        const double x = left + (right - left) * (tick - low) / (high > low ? high - low : 1);
        set_colour(cairo, colours.line);
        stroke_line(cairo, x, foot, x, foot + 0.35 * text);
        const std::string number = decimal(tick, ticks.decimals);
        // The margin may be narrower than half a number.
        const double half = type.width(number, style) / 2;
        type.draw(cairo, number, std::max(x, half), foot + 1.4 * text, style);
    }
}

void draw_scale_bar(cairo_t* cairo, double pixels_per_metre, double width, double right, double y,
                    const Theme& colours, const Typesetter& type, double text, double line) {
    const double metres = round_below(width / pixels_per_metre);
    const double x1 = std::round(right), x0 = std::round(x1 - metres * pixels_per_metre), tick = 0.35 * text;
    set_colour(cairo, colours.text);
    cairo_set_line_width(cairo, 1.5 * line);
    stroke_line(cairo, x0, y, x1, y);
    stroke_line(cairo, x0, y - tick, x0, y + tick);
    stroke_line(cairo, x1, y - tick, x1, y + tick);
    type.draw(cairo, format_si(metres, "m", 3, true), (x0 + x1) / 2, y - 0.7 * text,
              {.size = text, .colour = colours.text, .align = Align::centre});
}

}  // namespace

Image with_scales(const Image& picture, const FigureScales& scales, const FigureStyle& style) {
    const double text = style.text(), line = style.points(0.5), margin = style.margin();
    const int band = static_cast<int>(std::ceil((scales.colours ? 4.8 : 3) * text));
    Image image(picture.width, picture.height + band);
    const Theme& colours = theme(style.theme);
    const CairoSurface surface = surface_on(image);
    const CairoPen pen = pen_on(surface);
    cairo_t* cairo = pen.get();
    set_colour(cairo, colours.background);
    cairo_paint(cairo);
    const Typesetter type;
    const double top = picture.height + 0.4 * text, width = picture.width;
    if (scales.colours)
        draw_colours(cairo, *scales.colours, {margin, top, bar_share * width, band - 0.4 * text}, colours,
                     type, text, line);
    else
        type.draw(cairo, scales.note, margin, top + text, {.size = text, .colour = colours.faint_text});
    if (scales.pixels_per_metre > 0)
        draw_scale_bar(cairo, scales.pixels_per_metre, scale_bar_share * width, width - margin,
                       std::round(top + 2.1 * text), colours, type, text, line);
    cairo_surface_flush(surface.get());
    for (int y = 0; y < picture.height; ++y)
        std::memcpy(image.bgra.data() + static_cast<std::size_t>(y) * image.stride(),
                    picture.bgra.data() + static_cast<std::size_t>(y) * picture.stride(), picture.stride());
    return image;
}

}  // namespace hibi
