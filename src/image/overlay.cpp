#include "image/overlay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "image/axis.hpp"
#include "image/canvas.hpp"
#include "image/inset.hpp"
#include "image/layout.hpp"
#include "image/symbols.hpp"
#include "image/text.hpp"

namespace hibi {

namespace {

Parts wanted_parts(const View& view, const OverlayContent& content) {
    return {.title = view.shows("title") && !content.title.empty(),
            .subtitle = view.shows("title") && !content.subtitle.empty(),
            .time = view.shows("time"),
            .load = view.shows("load") && !content.load_title.empty(),
            .counts = view.shows("counts") && content.has_breaks,
            .colour_bar = view.shows("colour_bar"),
            .legend = view.shows("colour_bar") && content.has_breaks,
            .curve = view.shows("curve") && content.curve.time.size() > 1,
            .scale_bar = view.shows("scale_bar")};
}

/// Three significant digits of the largest value, for all.
int decimals_of(double largest) {
    return largest > 0 ? std::clamp(2 - static_cast<int>(std::floor(std::log10(largest))), 0, 6) : 0;
}

}  // namespace

struct Overlay::Impl {
    View view;
    OverlayContent content;
    const Theme& colours;
    Layout layout;
    Typesetter type;
    Scale time_scale, load_scale;
    int time_decimals = 0, load_decimals = 0;
    std::optional<Inset> inset;
    Image static_layer;  // premultiplied, transparent where nothing is drawn

    Impl(const View& v, OverlayContent c)
        : view(v),
          content(std::move(c)),
          colours(theme(v.theme)),
          layout(lay_out(v.width, v.height, wanted_parts(v, content))),
          time_scale(scale_for(content.time_end, "s")),
          load_scale(scale_for(content.load_max, content.load_unit)),
          load_decimals(decimals_of(std::abs(content.load_max) * load_scale.factor)),
          static_layer(v.width, v.height) {
        const double step = content.time_resolution * time_scale.factor;
        if (step > 0) time_decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-6)), 0, 6);
        if (layout.parts.curve)
            inset.emplace(content.curve, layout.curve, colours, type, layout.text, layout.unit);
        draw_static();
    }

    TextStyle style(const Rgb& colour, double size = 1, Align align = Align::left) const {
        return {.size = size * layout.text, .colour = colour, .tabular = true, .align = align};
    }
    TextStyle strong(const Rgb& colour, double size = 1, Align align = Align::left) const {
        TextStyle s = style(colour, size, align);
        s.strong = true;
        return s;
    }

    void draw_static() {
        const CairoSurface surface(cairo_image_surface_create_for_data(
            static_layer.bgra.data(), CAIRO_FORMAT_ARGB32, view.width, view.height, static_layer.stride()));
        const CairoPen pen = pen_on(surface);
        draw_title(pen.get());
        draw_readout_labels(pen.get());
        if (layout.parts.colour_bar) draw_colour_bar(pen.get());
        if (layout.parts.legend) draw_legend(pen.get());
        if (inset) inset->draw_axes(pen.get());
        cairo_surface_flush(surface.get());
    }

    /// One line, made smaller where it is too long; then two lines in place of title and subtitle; then cut.
    void draw_title(cairo_t* cairo) const {
        const PixelRect& r = layout.title;
        double y = r.y;
        bool subtitle = layout.parts.subtitle;
        if (layout.parts.title) {
            TextStyle s{.size = layout.title_size, .colour = colours.text, .strong = true};
            const double needed = type.width(content.title, s);
            if (needed > r.width) s.size *= std::max({0.7, layout.text / s.size, r.width / needed * 0.999});
            const int lines = std::max(1, static_cast<int>(r.height / (1.2 * s.size)));
            const std::vector<std::string> broken =
                type.wrapped(content.title, s, r.width, std::min(lines, 2));
            for (const std::string& line : broken) {
                type.draw(cairo, line, r.x, y + 0.95 * s.size, s);
                y += 1.2 * s.size;
            }
            if (broken.size() > 1) subtitle = false;
            y = r.y + 1.2 * layout.title_size;
        }
        if (!subtitle) return;
        const TextStyle s = style(colours.faint_text);
        type.draw(cairo, type.shortened(content.subtitle, s, r.width), r.x, y + 1.3 * layout.text, s);
    }

    double row_baseline(int row) const {
        const double first = layout.parts.time ? time_row : 0;
        return layout.readout.y + layout.text * (first + readout_row * row + 1.05);
    }

    void draw_readout_labels(cairo_t* cairo) const {
        int row = 0;
        const TextStyle s = style(colours.faint_text);
        const auto label = [&](const std::string& text, const std::string& widest) {
            const double room =
                layout.readout.width - type.width(widest, strong(colours.text)) - 0.6 * layout.text;
            type.draw(cairo, type.shortened(text, s, room), layout.readout.x, row_baseline(row++), s);
        };
        if (layout.parts.load) label(content.load_title, load_text(-std::abs(content.load_max)));
        if (layout.parts.counts) label("Broken bonds", "000");
    }

    void draw_colour_bar(cairo_t* cairo) const {
        const ColourBar& bar = content.colour_bar;
        const PixelRect& r = layout.colour_bar;
        const double text = layout.text;
        const Scale scale = scale_for(std::max(std::abs(bar.low), std::abs(bar.high)), bar.unit);
        double y = r.y;
        for (const std::string& line :
             type.wrapped(with_unit(bar.title, scale), style(colours.text), r.width, 2)) {
            type.draw(cairo, line, r.x, y + text, style(colours.text));
            y += 1.35 * text;
        }
        const int top = static_cast<int>(y + 0.55 * text);
        const int bottom = static_cast<int>(r.y + r.height - 0.5 * text);
        const double width = std::round(1.45 * text);
        const ColourMap& map = colour_map(bar.map);
        for (int row = top; row < bottom; ++row) {
            const auto& c =
                map[std::clamp(static_cast<int>(256.0 * (bottom - row - 0.5) / (bottom - top)), 0, 255)];
            cairo_set_source_rgb(cairo, c[0] / 255.0, c[1] / 255.0, c[2] / 255.0);
            cairo_rectangle(cairo, std::round(r.x), row, width, 1);
            cairo_fill(cairo);
        }
        const double low = bar.low * scale.factor, high = bar.high * scale.factor;
        const Ticks ticks =
            round_ticks(low, high, std::max(3, static_cast<int>((bottom - top) / (2.4 * text))));
        cairo_set_line_width(cairo, 1);
        for (const double tick : ticks.at) {
            const double at = bottom - (bottom - top) * (tick - low) / (high > low ? high - low : 1);
            set_colour(cairo, colours.line);
            const double x = std::round(r.x) + width;
            stroke_line(cairo, x, crisp(std::min(at, bottom - 0.5)), x + 0.4 * text,
                        crisp(std::min(at, bottom - 0.5)));
            type.draw(cairo, decimal(tick, ticks.decimals), x + 0.8 * text, at + 0.35 * text,
                      style(colours.text, 0.95));
        }
    }

    /// Samples on a chip of the body's own colour, as the cracks are seen.
    void draw_legend(cairo_t* cairo) const {
        const double text = layout.text, chip = 2.2 * text;
        double y = layout.legend.y + 0.9 * text;
        const ColourBar& bar = content.colour_bar;
        const double zero = std::clamp(-bar.low / (bar.high > bar.low ? bar.high - bar.low : 1), 0.0, 1.0);
        const auto& body = colour_map(bar.map)[static_cast<int>(255 * zero)];
        const auto entry = [&](const Rgb& colour, const std::string& words) {
            cairo_set_source_rgb(cairo, body[0] / 255.0, body[1] / 255.0, body[2] / 255.0);
            round_rect(cairo, {layout.legend.x, y - 0.5 * text, chip, text}, 0.25 * text);
            cairo_fill(cairo);
            set_colour(cairo, colour);
            cairo_set_line_width(cairo, std::max(1.5, 2.6 * layout.unit));
            cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
            stroke_line(cairo, layout.legend.x + 0.4 * text, y, layout.legend.x + chip - 0.4 * text, y);
            type.draw(cairo, words, layout.legend.x + chip + 0.6 * text, y + 0.36 * text,
                      style(colours.text));
            y += 1.55 * text;
        };
        entry(colours.crack_fresh, "just broken");
        entry(colours.crack_old, "broken earlier");
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    }

    std::string load_text(double load) const {
        return fmt::format("{} {}", decimal(load * load_scale.factor, load_decimals), load_scale.unit);
    }

    void draw_readout(cairo_t* cairo, const OverlayFrame& frame) const {
        const PixelRect& r = layout.readout;
        if (layout.parts.time) {
            TextStyle s = strong(colours.text, 1.45);
            const std::string number = decimal(frame.time * time_scale.factor, time_decimals);
            std::string text = fmt::format("{} = {} {}", content.time_symbol, number, time_scale.unit);
            const double needed = type.width(text, s);
            if (needed > r.width) s.size *= r.width / needed;
            type.draw(cairo, text, r.x, r.y + 1.4 * layout.text, s);
        }
        int row = 0;
        const double right = r.x + r.width;
        const TextStyle s = strong(colours.text, 1, Align::right);
        if (layout.parts.load) type.draw(cairo, load_text(frame.load), right, row_baseline(row++), s);
        if (layout.parts.counts)
            type.draw(cairo, fmt::format("{}", frame.broken), right, row_baseline(row++), s);
    }

    /// Returns its right end.
    double draw_scale_bar(cairo_t* cairo, const OverlayFrame& frame) const {
        const PixelRect& r = layout.footer;
        if (!layout.parts.scale_bar || !(frame.pixels_per_metre > 0)) return r.x;
        const double metres = round_below(0.22 * r.width / frame.pixels_per_metre);
        const double x0 = std::round(r.x), x1 = std::round(r.x + metres * frame.pixels_per_metre);
        const double y = crisp(r.y + 0.6 * r.height), tick = 0.35 * layout.text;
        set_colour(cairo, colours.text);
        cairo_set_line_width(cairo, std::max(1.0, std::round(1.5 * layout.unit)));
        stroke_line(cairo, x0, y, x1, y);
        stroke_line(cairo, x0 + 0.5, y - tick, x0 + 0.5, y + tick);
        stroke_line(cairo, x1 - 0.5, y - tick, x1 - 0.5, y + tick);
        const std::string label = format_si(metres, "m", 3, true);
        type.draw(cairo, label, x1 + 0.7 * layout.text, y + 0.36 * layout.text, style(colours.text));
        return x1 + 0.7 * layout.text + type.width(label, style(colours.text));
    }

    /// From the right end of the footer leftwards, as far as there is room beside the scale bar.
    void draw_moment(cairo_t* cairo, const OverlayFrame& frame, double left) const {
        const PixelRect& r = layout.footer;
        const double text = layout.text, middle = r.y + 0.6 * r.height;
        double right = r.x + r.width;
        const auto fits = [&](double width) { return r.height > 0 && right - width > left + text; };
        if (frame.event && frame.event_strength > 0) {
            TextStyle s = strong(colours.background, 1, Align::centre);
            const double width = type.width(*frame.event, s) + 1.6 * text;
            if (fits(width)) {
                cairo_push_group(cairo);
                set_colour(cairo, colours.curve_second);
                round_rect(cairo, {right - width, middle - 0.9 * text, width, 1.8 * text}, 0.9 * text);
                cairo_fill(cairo);
                type.draw(cairo, *frame.event, right - width / 2, middle + 0.36 * text, s);
                cairo_pop_group_to_source(cairo);
                cairo_paint_with_alpha(cairo, frame.event_strength);
                right -= width + text;
            }
        }
        if (frame.speed < 0.67 && frame.speed > 0) {
            const double factor = 1 / frame.speed;
            const std::string words = fmt::format("{:.{}f}× slow motion", factor, factor < 9.95 ? 1 : 0);
            const TextStyle s = style(colours.faint_text, 1, Align::right);
            if (fits(type.width(words, s))) type.draw(cairo, words, right, middle + 0.36 * text, s);
        }
    }
};

Overlay::Overlay(const View& view, OverlayContent content)
    : impl_(std::make_unique<Impl>(view, std::move(content))) {}
Overlay::~Overlay() = default;

PixelRect Overlay::plot() const { return impl_->layout.plot; }

void Overlay::draw(Image& image, const OverlayFrame& frame) const {
    const Layout& layout = impl_->layout;
    const CairoSurface surface = surface_on(image);
    const CairoPen pen = pen_on(surface);
    cairo_t* cairo = pen.get();
    cairo_save(cairo);
    cairo_rectangle(cairo, layout.plot.x, layout.plot.y, layout.plot.width, layout.plot.height);
    cairo_clip(cairo);
    for (const Symbol& symbol : frame.symbols)
        draw_symbol(cairo, symbol, impl_->colours, symbol_unit(impl_->view));
    cairo_restore(cairo);

    const CairoSurface layer(cairo_image_surface_create_for_data(
        impl_->static_layer.bgra.data(), CAIRO_FORMAT_ARGB32, image.width, image.height, image.stride()));
    cairo_set_source_surface(cairo, layer.get(), 0, 0);
    for (const PixelRect& r :
         {layout.title, layout.readout, layout.colour_bar, layout.legend, layout.curve}) {
        // Whole pixels, and a little more, for accents and the like that reach beyond.
        const double x = std::floor(r.x) - 8, y = std::floor(r.y) - 8;
        if (r.width > 0 && r.height > 0)
            cairo_rectangle(cairo, x, y, std::ceil(r.width) + 16, std::ceil(r.height) + 16);
    }
    cairo_fill(cairo);

    impl_->draw_readout(cairo, frame);
    const double left = impl_->draw_scale_bar(cairo, frame);
    impl_->draw_moment(cairo, frame, left);
    if (impl_->inset) impl_->inset->draw_lines(cairo, frame.time);
    cairo_surface_flush(surface.get());
}

}  // namespace hibi
