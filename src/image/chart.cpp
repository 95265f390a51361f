#include "image/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/chart_drawing.hpp"
#include "image/ink.hpp"

namespace hibi {

namespace {

constexpr double mm = 72 / 25.4;  // in points, as all lengths here; images scale the pen
constexpr double least_chart_mm = 75, between_mm = 5, between_rows_mm = 7;

/// All charts of a figure in their places.
class Figure {
 public:
    Figure(const std::vector<Chart>& charts, const FigureStyle& style) : width_(style.width_mm * mm) {
        const double margin = style.margin() / style.points(1), inner = width_ - 2 * margin;
        const double between = between_mm * mm;
        const int most = static_cast<int>((inner + between) / (least_chart_mm * mm + between));
        const int count = static_cast<int>(charts.size()), columns = std::clamp(most, 1, std::max(1, count));
        const double width = (inner - (columns - 1) * between) / columns;
        drawings_.reserve(charts.size());
        double y = margin;
        for (int begin = 0; begin < count; begin += columns) {
            const int end = std::min(begin + columns, count);
            double head = 0, rest = 0;
            for (int k = begin; k < end; ++k) {
                drawings_.emplace_back(charts[k], margin + (k - begin) * (width + between), width, style,
                                       type_);
                head = std::max(head, drawings_.back().head());
                rest = std::max(rest, drawings_.back().height_from_axes());
            }
            for (int k = begin; k < end; ++k) drawings_[k].place(y + head);
            y += head + rest + (end < count ? between_rows_mm * mm : margin);
        }
        height_ = std::max(y, 2 * margin);
    }
    double width() const { return width_; }
    double height() const { return height_; }
    const Typesetter& type() const { return type_; }
    const std::vector<ChartDrawing>& drawings() const { return drawings_; }

    void draw(Ink& ink, const Rgb& background) const {
        cairo_rectangle(ink.path(), 0, 0, width_, height_);
        ink.fill(background);
        for (const ChartDrawing& drawing : drawings_) drawing.draw(ink);
    }

 private:
    Typesetter type_;
    std::vector<ChartDrawing> drawings_;
    double width_, height_ = 0;
};

}  // namespace

double ChartPlace::pixel_x(double value) const {
    return axes.x + axes.width * axis_share(x, x_logarithmic, value);
}
double ChartPlace::pixel_y(double value) const {
    return axes.y + axes.height * (1 - axis_share(y, y_logarithmic, value));
}

Image chart_image(const std::vector<Chart>& charts, const FigureStyle& style) {
    const Figure figure(charts, style);
    const double scale = style.width() / figure.width();
    Image image(style.width(), static_cast<int>(std::lround(figure.height() * scale)));
    const CairoSurface surface = surface_on(image);
    const CairoPen pen = pen_on(surface);
    const Rgb& background = theme(style.theme).background;
    set_colour(pen.get(), background);
    cairo_paint(pen.get());  // to the last pixel
    cairo_scale(pen.get(), scale, scale);
    Ink ink(pen.get(), figure.type());
    figure.draw(ink, background);
    cairo_surface_flush(surface.get());
    return image;
}

std::string chart_svg(const std::vector<Chart>& charts, const FigureStyle& style,
                      std::vector<ChartPlace>* places, std::string metadata) {
    const Figure figure(charts, style);
    std::string title;
    for (const Chart& chart : charts) {
        const std::string own =
            chart.title.empty() ? fmt::format("{} over {}", chart.y.title, chart.x.title) : chart.title;
        title += (title.empty() ? "" : "; ") + own;
    }
    std::string svg = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" "
        "width=\"{:.2f}mm\" height=\"{:.2f}mm\" viewBox=\"0 0 {:.2f} {:.2f}\">\n<title>{}</title>\n",
        figure.width() / mm, figure.height() / mm, figure.width(), figure.height(), xml_escaped(title));
    if (!metadata.empty()) {
        // Quotation marks stay, so that what is JSON stays readable.
        for (const auto& [character, code] : {std::pair('&', "&amp;"), std::pair('<', "&lt;")})
            for (std::size_t at = 0; (at = metadata.find(character, at)) != std::string::npos; ++at)
                metadata.replace(at, 1, code);
        svg += "<metadata>" + metadata + "</metadata>\n";
    }
    Ink ink(svg, figure.type());
    figure.draw(ink, theme(style.theme).background);
    if (places)
        for (const ChartDrawing& drawing : figure.drawings()) places->push_back(drawing.place());
    return svg + "</svg>\n";
}

}  // namespace hibi
