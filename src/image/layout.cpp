#include "image/layout.hpp"

#include <algorithm>
#include <functional>

namespace hibi {

namespace {

bool has_side(const Parts& p) { return p.time || p.load || p.counts || p.colour_bar || p.legend || p.curve; }

double readout_height(const Layout& l) {
    return l.text * ((l.parts.time ? time_row : 0) + readout_row * (l.parts.load + l.parts.counts));
}
double legend_height(const Layout& l) { return 3.3 * l.text; }
double least_bar(const Layout& l) { return 8 * l.text; }
double least_curve(const Layout& l) { return 13 * l.text; }
/// Between two parts, one above the other.
double gap(const Layout& l) { return std::max(1.2 * l.text, 24 * l.unit); }

/// Title above, plot and footer inside the rectangle that the column or band leaves free.
void place_main(Layout& l, const PixelRect& area) {
    Parts& p = l.parts;
    if (p.subtitle && area.height < 22 * l.text) p.subtitle = false;
    if (p.title && area.height < 5 * l.title_size) p.title = false;
    if (p.scale_bar && area.height < 9 * l.text) p.scale_bar = false;
    double top = 0;
    if (p.title) top += 1.2 * l.title_size;
    if (p.subtitle) top += 1.75 * l.text;
    l.title = {area.x, area.y, area.width, top};
    if (top > 0) top += std::max(0.6 * l.text, 14 * l.unit);
    const double bottom = area.height < 9 * l.text ? 0 : 2.2 * l.text;
    l.plot = {area.x, area.y + top, area.width, std::max(1.0, area.height - top - bottom)};
    l.footer = {area.x, l.plot.y + l.plot.height, area.width, bottom};
}

/// One under the other, the curve at the foot, the colour bar taking what is left up to its usual height.
void place_column(Layout& l, const PixelRect& column) {
    Parts& p = l.parts;
    const auto needed = [&] {
        const int count = (p.time || p.load || p.counts) + p.colour_bar + p.curve;
        return readout_height(l) + (p.colour_bar ? least_bar(l) : 0) + (p.legend ? legend_height(l) : 0) +
               (p.curve ? least_curve(l) : 0) + std::max(0, count - 1) * gap(l);
    };
    for (bool* part : {&p.curve, &p.legend, &p.counts, &p.load, &p.colour_bar, &p.time})
        if (needed() > column.height) *part = false;
    double room = column.height - needed();
    double y = column.y;
    l.readout = {column.x, y, column.width, readout_height(l)};
    if (l.readout.height > 0) y += l.readout.height + gap(l);
    if (p.colour_bar) {
        const double extra = std::min(p.curve ? 0.55 * room : room, 300 * l.unit - least_bar(l));
        l.colour_bar = {column.x, y, column.width, least_bar(l) + std::max(0.0, extra)};
        room -= std::max(0.0, extra);
        y += l.colour_bar.height;
    }
    if (p.legend) l.legend = {column.x, y, column.width, legend_height(l)};
    if (p.curve) {
        const double height =
            least_curve(l) + std::clamp(room, 0.0, std::max(0.0, 230 * l.unit - least_curve(l)));
        l.curve = {column.x, column.y + column.height - height, column.width, height};
    }
}

/// Readout and legend, colour bar, curve side by side.
void place_band(Layout& l, const PixelRect& band) {
    Parts& p = l.parts;
    const double bar_width = 8.5 * l.text;
    if (p.curve && (band.height < least_curve(l) || band.width < 37 * l.text)) p.curve = false;
    for (bool* part : {&p.legend, &p.counts, &p.load, &p.time})
        if (readout_height(l) + (p.legend ? legend_height(l) : 0) > band.height) *part = false;
    if (p.colour_bar && (band.height < least_bar(l) || band.width < bar_width)) p.colour_bar = false;
    const bool has_text = p.time || p.load || p.counts || p.legend;
    const double space = 2.2 * l.text;
    const double text_width =
        has_text ? std::min(13.5 * l.text, band.width - (p.colour_bar ? bar_width + space : 0)) : 0;
    double x = band.x;
    l.readout = {x, band.y, text_width, readout_height(l)};
    l.legend = {x, band.y + band.height - legend_height(l), text_width, p.legend ? legend_height(l) : 0};
    if (has_text) x += text_width + space;
    if (p.colour_bar) {
        l.colour_bar = {x, band.y, bar_width, band.height};
        x += bar_width + space;
    }
    if (p.curve) l.curve = {x, band.y, band.x + band.width - x, band.height};
}

}  // namespace

Layout lay_out(int width, int height, const Parts& wanted) {
    const double w = width, h = height;
    const bool wide = w >= 1.2 * h;
    Layout l;
    l.parts = wanted;
    l.unit = std::min(w / (wide ? 1280 : 720), h / 720);
    l.text = std::max({12 * l.unit, 7.5 + 4.5 * l.unit, 9.0});
    l.title_size = std::max(23 * l.unit, 1.35 * l.text);
    const double margin = std::max(40 * l.unit, 10.0);
    PixelRect area = {margin, 0.8 * margin, std::max(1.0, w - 2 * margin), std::max(1.0, h - 1.6 * margin)};
    if (area.width < 12 * l.text || area.height < 8 * l.text) {  // a thumbnail: the body alone
        l.parts = {false, false, false, false, false, false, false, false, false};
        place_main(l, area);
        return l;
    }
    if (has_side(wanted) && wide) {
        const double column = std::min(17 * l.text, 0.3 * w);
        const double between = std::max(36 * l.unit, 12.0);
        place_column(l, {w - margin - column, area.y, column, area.height});
        area.width -= column + between;
    } else if (has_side(wanted)) {
        const double band = std::clamp(0.27 * h, 15.5 * l.text, 21 * l.text);
        const double used = std::min(band, 0.4 * area.height);
        place_band(l, {area.x, area.y + area.height - used, area.width, used});
        area.height -= used + gap(l);
    }
    place_main(l, area);
    return l;
}

}  // namespace hibi
