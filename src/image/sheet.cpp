#include "image/sheet.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "image/canvas.hpp"
#include "image/text.hpp"

namespace hibi {

namespace {

constexpr double gap_mm = 2.5, line_height = 1.35;  // between panels; of text, in text sizes

int gap(const FigureStyle& style) { return static_cast<int>(style.mm(gap_mm)); }
int margin(const FigureStyle& style) { return static_cast<int>(style.margin()); }

}  // namespace

int panel_width(int columns, const FigureStyle& style) {
    return (style.width() - 2 * margin(style) - (columns - 1) * gap(style)) / columns;
}

Image make_sheet(const std::vector<Panel>& panels, const std::string& title, int columns,
                 const FigureStyle& style) {
    assert(columns > 0);
    const int width = panel_width(columns, style), between = gap(style);
    const double text = style.text();
    const Theme& colours = theme(style.theme);
    const Typesetter type;
    TextStyle strong{.size = text, .colour = colours.text, .strong = true};
    const TextStyle plain{.size = text, .colour = colours.faint_text, .tabular = true};

    int height = 0, label_lines = 0, detail_lines = 0;
    std::vector<std::vector<std::string>> labels, details;
    for (const Panel& panel : panels) {
        height = std::max(height, panel.image.height);
        labels.push_back(type.wrapped(panel.label, strong, width, 2));
        details.push_back(type.wrapped(panel.detail, plain, width, 2));
        label_lines = std::max(label_lines, static_cast<int>(labels.back().size()));
        detail_lines =
            std::max(detail_lines, panel.detail.empty() ? 0 : static_cast<int>(details.back().size()));
    }
    const double caption = (label_lines + detail_lines) * line_height * text + 0.5 * text;
    const int row = height + static_cast<int>(caption) + between;
    const int rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
    const int left = margin(style), head = left + (title.empty() ? 0 : static_cast<int>(2.4 * text));
    Image image(style.width(), head + rows * row - between + left);
    const CairoSurface surface = surface_on(image);
    const CairoPen pen = pen_on(surface);
    cairo_t* cairo = pen.get();
    set_colour(cairo, colours.background);
    cairo_paint(cairo);
    if (!title.empty()) {
        strong.size = 1.25 * text;
        type.draw(cairo, type.shortened(title, strong, image.width - 2 * left), left, left + 1.1 * text,
                  strong);
        strong.size = text;
    }
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const int x = left + static_cast<int>(k) % columns * (width + between);
        const int y = head + static_cast<int>(k) / columns * row;
        double line = y + height + 1.15 * text;
        for (const std::string& words : labels[k]) {
            type.draw(cairo, words, x, line, strong);
            line += line_height * text;
        }
        line = y + height + 1.15 * text + label_lines * line_height * text;
        for (const std::string& words : details[k]) {
            type.draw(cairo, words, x, line, plain);
            line += line_height * text;
        }
    }
    cairo_surface_flush(surface.get());
    for (std::size_t k = 0; k < panels.size(); ++k) {
        const Image& picture = panels[k].image;
        assert(picture.width <= width);
        const int x = left + static_cast<int>(k) % columns * (width + between);
        const int y = head + static_cast<int>(k) / columns * row;
        for (int r = 0; r < picture.height; ++r)
            std::memcpy(image.pixel(x, y + r), picture.pixel(0, r),
                        4 * static_cast<std::size_t>(picture.width));
    }
    return image;
}

}  // namespace hibi
