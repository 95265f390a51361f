#include "image/chart.hpp"

#include <cairo-svg.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "image/axis.hpp"
#include "image/canvas.hpp"
#include "image/text.hpp"

namespace hibi {

namespace {

// Everything here is in points; images scale the pen.
constexpr double least_chart_mm = 75, between_mm = 6;
constexpr double height_share = 0.66;  // of a chart's width, without legend and note
constexpr double line_width = 1.1, thin_line = 0.5, dot = 1.9, closest = 0.35;

bool shown(double value, bool logarithmic) { return std::isfinite(value) && (!logarithmic || value > 0); }

/// The ends of an axis, a little beyond the values.
std::array<double, 2> axis_range(const ChartAxis& axis, const std::vector<const std::vector<double>*>& all) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::vector<double>* values : all)
        for (const double v : *values)
            if (shown(v, axis.logarithmic)) low = std::min(low, v), high = std::max(high, v);
    if (!(low <= high)) return axis.logarithmic ? std::array{1.0, 10.0} : std::array{0.0, 1.0};
    if (axis.logarithmic) {
        const double factor = std::max(std::pow(high / low, 0.06), 1.15);
        return {low / factor, high * factor};
    }
    if (axis.from_zero) low = std::min(low, 0.0), high = std::max(high, 0.0);
    const double span = high > low ? high - low : std::max(std::abs(high), 1.0);
    const double beyond = 0.04 * span;
    return {axis.from_zero && low == 0 ? 0 : low - beyond, axis.from_zero && high == 0 ? 0 : high + beyond};
}

/// Decades, and 2 and 5 between them where few decades are seen.
std::vector<double> log_ticks(double low, double high) {
    std::vector<double> ticks;
    const bool dense = high / low < 200;
    for (double power = std::pow(10, std::floor(std::log10(low))); power <= high; power *= 10)
        for (const double lead : {1.0, 2.0, 5.0})
            if ((lead == 1 || dense) && lead * power >= low && lead * power <= high)
                ticks.push_back(lead * power);
    return ticks;
}

struct Tick {
    double value = 0;  // SI
    std::string text;
};

/// The values themselves, where they are so few that each can stand at its axis; else nothing.
std::vector<double> few(const std::vector<const std::vector<double>*>& all) {
    constexpr std::size_t most = 6;
    std::set<double> values;
    for (const std::vector<double>* list : all)
        for (const double v : *list)
            if (shown(v, true)) values.insert(v);
    if (values.size() > most) return {};
    return {values.begin(), values.end()};
}

/// An axis, ready to be drawn.
struct Axis {
    std::array<double, 2> range;
    Scale scale;
    std::string title;
    std::vector<Tick> ticks;

    Axis(const ChartAxis& axis, const std::vector<const std::vector<double>*>& values, int most)
        : range(axis_range(axis, values)),
          scale(scale_for(std::max(std::abs(range[0]), std::abs(range[1])) / 1.05, axis.unit)),
          title(with_unit(axis.title, scale)) {
        if (axis.logarithmic) {
            for (const double v : few(values).empty() ? log_ticks(range[0], range[1]) : few(values))
                ticks.push_back({v, fmt::format("{:.3g}", v * scale.factor)});
            return;
        }
        const Ticks round = round_ticks(range[0] * scale.factor, range[1] * scale.factor, most);
        for (const double v : round.at) ticks.push_back({v / scale.factor, decimal(v, round.decimals)});
    }
};

struct Box {
    double x, y, width, height;
    bool overlaps(const Box& b) const {
        return x < b.x + b.width && b.x < x + width && y < b.y + b.height && b.y < y + height;
    }
    bool holds(double px, double py) const {
        return px >= x && px <= x + width && py >= y && py <= y + height;
    }
};

class ChartDrawing {
 public:
    /// At (x, y), so wide, as high as it has to be.
    ChartDrawing(const Chart& chart, double x, double y, double width, const FigureStyle& style,
                 const Typesetter& type)
        : chart_(chart),
          colours_(theme(style.theme)),
          type_(type),
          text_(style.text_pt),
          left_(x),
          top_(y),
          width_(width),
          x_(chart.x, values(&ChartLine::x), std::max(2, static_cast<int>(width / (4.5 * text_)))),
          y_(chart.y, values(&ChartLine::y),
             std::max(2, static_cast<int>(height_share * width / (2.4 * text_)))) {
        double head = chart.title.empty() ? 0 : 1.8 * text_;
        title_y_ = y + 1.1 * text_;
        y_title_y_ = y + head + 1.1 * text_;
        head += 1.7 * text_;
        legend_y_ = y + head;
        place_legend();
        head += 1.45 * text_ * legend_rows_ + 0.3 * text_;
        double margin = 0;
        for (const Tick& tick : y_.ticks) margin = std::max(margin, type.width(tick.text, tick_style()));
        margin += 0.8 * text_;
        // Half of the last number of the horizontal axis may stand beyond its end.
        const double right =
            0.4 * text_ + (x_.ticks.empty() ? 0 : type.width(x_.ticks.back().text, tick_style()) / 2);
        place_.axes = {x + margin, y + head, width - margin - right, height_share * width};
        place_.x = x_.range;
        place_.y = y_.range;
        place_.x_logarithmic = chart.x.logarithmic;
        place_.y_logarithmic = chart.y.logarithmic;
        foot_ = place_.axes.y + place_.axes.height;
        note_ = type.wrapped(chart.note, plain(colours_.faint_text), width, 8);
        height_ = foot_ + 3.2 * text_ + 1.4 * text_ * static_cast<double>(note_.size()) - y;
    }

    double height() const { return height_; }
    const ChartPlace& place() const { return place_; }

    void draw(cairo_t* cairo) const {
        TextStyle strong = plain(colours_.text);
        strong.strong = true;
        if (!chart_.title.empty())
            type_.draw(cairo, type_.shortened(chart_.title, strong, width_), left_, title_y_, strong);
        type_.draw(cairo, y_.title, left_, y_title_y_, plain(colours_.text));
        draw_axes(cairo);
        draw_legend(cairo);
        cairo_save(cairo);
        const PixelRect& r = place_.axes;
        cairo_rectangle(cairo, r.x - 2 * dot, r.y - 2 * dot, r.width + 4 * dot, r.height + 4 * dot);
        cairo_clip(cairo);
        for (const ChartLine& line : chart_.lines) draw_line(cairo, line);
        cairo_restore(cairo);
        draw_marks(cairo);
        double y = foot_ + 4.2 * text_;
        for (const std::string& line : note_) {
            type_.draw(cairo, line, left_, y, plain(colours_.faint_text));
            y += 1.4 * text_;
        }
    }

 private:
    std::vector<const std::vector<double>*> values(std::vector<double> ChartLine::*member) const {
        std::vector<const std::vector<double>*> all;
        for (const ChartLine& line : chart_.lines) all.push_back(&(line.*member));
        return all;
    }
    TextStyle plain(const Rgb& colour) const { return {.size = text_, .colour = colour, .tabular = true}; }
    TextStyle tick_style(Align align = Align::left) const {
        return {.size = 0.9 * text_, .colour = colours_.faint_text, .tabular = true, .align = align};
    }
    const Rgb& colour(const ChartLine& line) const {
        return colours_.series[static_cast<std::size_t>(line.colour) % colours_.series.size()];
    }

    struct Entry {
        const ChartLine* line;
        double x, y;
    };
    void place_legend() {
        int named = 0;
        for (const ChartLine& line : chart_.lines) named += !line.label.empty();
        if (named < 2) return;
        double x = 0;
        for (const ChartLine& line : chart_.lines) {
            if (line.label.empty()) continue;
            const double width = 2.6 * text_ + type_.width(line.label, plain(colours_.text)) + 1.2 * text_;
            if (x > 0 && x + width - 1.2 * text_ > width_) x = 0, ++legend_rows_;
            if (legend_rows_ == 0) legend_rows_ = 1;
            legend_.push_back({&line, left_ + x, legend_y_ + 1.45 * text_ * (legend_rows_ - 1) + text_});
            x += width;
        }
    }
    void draw_legend(cairo_t* cairo) const {
        for (const Entry& entry : legend_) {
            const double y = entry.y - 0.33 * text_;
            set_pen(cairo, *entry.line);
            if (entry.line->line) stroke_line(cairo, entry.x, y, entry.x + 2 * text_, y);
            cairo_set_dash(cairo, nullptr, 0, 0);
            if (entry.line->points) draw_dot(cairo, entry.x + text_, y);
            type_.draw(cairo, entry.line->label, entry.x + 2.5 * text_, entry.y, plain(colours_.text));
        }
    }

    void draw_axes(cairo_t* cairo) const {
        const PixelRect& r = place_.axes;
        cairo_set_line_width(cairo, thin_line);
        for (const Tick& tick : y_.ticks) {
            const double y = place_.pixel_y(tick.value);
            set_colour(cairo, colours_.grid);
            stroke_line(cairo, r.x, y, r.x + r.width, y);
            type_.draw(cairo, tick.text, r.x - 0.5 * text_, y + 0.32 * text_, tick_style(Align::right));
        }
        double taken = -std::numeric_limits<double>::infinity();
        for (const Tick& tick : x_.ticks) {
            const double x = place_.pixel_x(tick.value);
            set_colour(cairo, colours_.line);
            stroke_line(cairo, x, foot_, x, foot_ + 0.35 * text_);
            const double half = type_.width(tick.text, tick_style()) / 2;
            if (x - half < taken + 0.4 * text_) continue;
            taken = x + half;
            type_.draw(cairo, tick.text, x, foot_ + 1.35 * text_, tick_style(Align::centre));
        }
        set_colour(cairo, colours_.line);
        stroke_line(cairo, r.x, r.y, r.x, foot_);
        stroke_line(cairo, r.x, foot_, r.x + r.width, foot_);
        TextStyle style = plain(colours_.text);
        style.align = Align::centre;
        type_.draw(cairo, x_.title, r.x + r.width / 2, foot_ + 2.7 * text_, style);
    }

    void set_pen(cairo_t* cairo, const ChartLine& line) const {
        set_colour(cairo, colour(line));
        cairo_set_line_width(cairo, line_width);
        cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
        const double dashes[] = {3, 2};
        cairo_set_dash(cairo, dashes, line.dashed ? 2 : 0, 0);
    }
    void draw_dot(cairo_t* cairo, double x, double y) const {
        cairo_new_sub_path(cairo);
        cairo_arc(cairo, x, y, dot, 0, 6.283185307179586);
        cairo_fill(cairo);
    }

    void draw_line(cairo_t* cairo, const ChartLine& line) const {
        set_pen(cairo, line);
        const std::size_t count = std::min(line.x.size(), line.y.size());
        if (line.line) {
            bool begun = false;
            double x0 = 0, y0 = 0;
            for (std::size_t k = 0; k < count; ++k) {
                if (!has(line, k)) {
                    begun = false;
                    continue;
                }
                const double x = place_.pixel_x(line.x[k]), y = place_.pixel_y(line.y[k]);
                // Points that nobody could tell apart only make the file large.
                const bool last = k + 1 == count || !has(line, k + 1);
                if (begun && !last && std::hypot(x - x0, y - y0) < closest) continue;
                begun ? cairo_line_to(cairo, x, y) : cairo_move_to(cairo, x, y);
                begun = true;
                x0 = x, y0 = y;
            }
            cairo_stroke(cairo);
        }
        cairo_set_dash(cairo, nullptr, 0, 0);
        if (line.points)
            for (std::size_t k = 0; k < count; ++k)
                if (has(line, k)) draw_dot(cairo, place_.pixel_x(line.x[k]), place_.pixel_y(line.y[k]));
    }
    bool has(const ChartLine& line, std::size_t k) const {
        return shown(line.x[k], chart_.x.logarithmic) && shown(line.y[k], chart_.y.logarithmic);
    }

    /// How many points of the curves a box would hide.
    int hidden_by(const Box& box) const {
        int hidden = 0;
        for (const ChartLine& line : chart_.lines)
            for (std::size_t k = 0; k < std::min(line.x.size(), line.y.size()); ++k)
                hidden += has(line, k) && box.holds(place_.pixel_x(line.x[k]), place_.pixel_y(line.y[k]));
        return hidden;
    }

    void draw_marks(cairo_t* cairo) const {
        const PixelRect& r = place_.axes;
        std::vector<Box> taken;
        for (const ChartMark& mark : chart_.marks)
            if (mark.y)
                taken.push_back(
                    {place_.pixel_x(mark.x) - 2 * dot, place_.pixel_y(*mark.y) - 2 * dot, 4 * dot, 4 * dot});
        for (const ChartMark& mark : chart_.marks) {
            const double x = place_.pixel_x(mark.x), y = mark.y ? place_.pixel_y(*mark.y) : r.y;
            set_colour(cairo, colours_.text);
            if (mark.y) {
                draw_dot(cairo, x, y);
            } else {
                cairo_set_line_width(cairo, thin_line);
                const double dashes[] = {1.5, 1.5};
                cairo_set_dash(cairo, dashes, 2, 0);
                stroke_line(cairo, x, r.y, x, r.y + r.height);
                cairo_set_dash(cairo, nullptr, 0, 0);
            }
            const TextStyle style{.size = 0.9 * text_, .colour = colours_.text, .tabular = true};
            const double width = type_.width(mark.label, style), height = 1.2 * text_, off = 2.2 * dot;
            // Beside the dot and, where that is full, ever further away.
            Box best{};
            int least = std::numeric_limits<int>::max();
            for (int ring = 0; ring < 4 && least > 0; ++ring)
                for (const auto& [dx, dy] : {std::array{off, -height / 2},
                                             {-width - off, -height / 2},
                                             {-width - 0.5 * off, -height - off},
                                             {0.5 * off, -height - off},
                                             {0.5 * off, off},
                                             {-width - 0.5 * off, off}}) {
                    const Box box{x + dx, y + dy + (dy < -height ? -1 : 1) * ring * 1.1 * height, width,
                                  height};
                    if (box.x < r.x || box.x + box.width > left_ + width_ || box.y < r.y - 0.2 * text_ ||
                        box.y + box.height > foot_)
                        continue;
                    int cost = hidden_by(box) + 4 * ring;
                    for (const Box& other : taken) cost += other.overlaps(box) ? 1000 : 0;
                    for (const ChartMark& other : chart_.marks) {
                        const double at = place_.pixel_x(other.x);
                        if (!other.y && at > box.x && at < box.x + box.width) cost += 50;
                    }
                    if (cost < least) least = cost, best = box;
                }
            if (least >= 1000) continue;  // no room: the dot alone
            taken.push_back(best);
            set_colour(cairo, colours_.background, 0.8);  // a line that runs behind it
            cairo_rectangle(cairo, best.x, best.y, best.width, best.height);
            cairo_fill(cairo);
            type_.draw(cairo, mark.label, best.x, best.y + 0.9 * text_, style);
        }
    }

    const Chart& chart_;
    const Theme& colours_;
    const Typesetter& type_;
    double text_, left_, top_, width_;
    Axis x_, y_;
    std::vector<Entry> legend_;
    int legend_rows_ = 0;
    double title_y_ = 0, y_title_y_ = 0, legend_y_ = 0, foot_ = 0, height_ = 0;
    std::vector<std::string> note_;
    ChartPlace place_;
};

/// All charts of a figure in their places.
class Figure {
 public:
    Figure(const std::vector<Chart>& charts, const FigureStyle& style) {
        constexpr double mm = 72 / 25.4;
        width_ = style.width_mm * mm;
        const double margin = style.margin() / style.points(1), inner = width_ - 2 * margin;
        const int most =
            std::max(1, static_cast<int>((style.width_mm + between_mm) / (least_chart_mm + between_mm)));
        const int columns = std::min(most, std::max(1, static_cast<int>(charts.size())));
        const double between = between_mm * mm, width = (inner - (columns - 1) * between) / columns;
        double y = margin, row = 0;
        for (std::size_t k = 0; k < charts.size(); ++k) {
            const int column = static_cast<int>(k) % columns;
            if (column == 0 && k > 0) y += row + between, row = 0;
            drawings_.emplace_back(charts[k], margin + column * (width + between), y, width, style, type_);
            row = std::max(row, drawings_.back().height());
        }
        height_ = y + row + margin;
    }
    double width() const { return width_; }
    double height() const { return height_; }
    const std::vector<ChartDrawing>& drawings() const { return drawings_; }

    void draw(cairo_t* cairo, const Rgb& background) const {
        set_colour(cairo, background);
        cairo_paint(cairo);
        for (const ChartDrawing& drawing : drawings_) drawing.draw(cairo);
    }

 private:
    Typesetter type_;
    std::vector<ChartDrawing> drawings_;
    double width_ = 0, height_ = 0;
};

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text)
        result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    return result;
}

double along(const std::array<double, 2>& range, bool logarithmic, double value) {
    return logarithmic ? std::log(value / range[0]) / std::log(range[1] / range[0])
                       : (value - range[0]) / (range[1] - range[0]);
}

}  // namespace

double ChartPlace::pixel_x(double value) const {
    return axes.x + axes.width * along(x, x_logarithmic, value);
}
double ChartPlace::pixel_y(double value) const {
    return axes.y + axes.height * (1 - along(y, y_logarithmic, value));
}

Image chart_image(const std::vector<Chart>& charts, const FigureStyle& style) {
    const Figure figure(charts, style);
    const double scale = style.points(1);
    Image image(style.width(), std::max(1, static_cast<int>(std::ceil(figure.height() * scale))));
    const CairoSurface surface = surface_on(image);
    const CairoPen pen = pen_on(surface);
    cairo_scale(pen.get(), scale, scale);
    figure.draw(pen.get(), theme(style.theme).background);
    cairo_surface_flush(surface.get());
    return image;
}

std::string chart_svg(const std::vector<Chart>& charts, const FigureStyle& style,
                      std::vector<ChartPlace>* places) {
    const Figure figure(charts, style);
    std::string svg;
    const auto append = [](void* to, const unsigned char* bytes, unsigned count) {
        static_cast<std::string*>(to)->append(reinterpret_cast<const char*>(bytes), count);
        return CAIRO_STATUS_SUCCESS;
    };
    {
        const CairoSurface surface(
            cairo_svg_surface_create_for_stream(append, &svg, figure.width(), figure.height()));
        cairo_svg_surface_set_document_unit(surface.get(), CAIRO_SVG_UNIT_PT);
        const CairoPen pen = pen_on(surface);
        figure.draw(pen.get(), theme(style.theme).background);
        cairo_surface_finish(surface.get());
    }
    // Cairo counts its surfaces, and the second figure of a program would differ from the first.
    const std::size_t id = svg.find(" id=\"surface");
    if (id != std::string::npos) svg.erase(id, svg.find('"', id + 5) + 1 - id);
    std::string title;
    for (const Chart& chart : charts)
        title += (title.empty() ? "" : "; ") + (chart.title.empty() ? chart.y.title : chart.title);
    const std::size_t open = svg.find('>', svg.find("<svg"));
    svg.insert(open + 1, "\n<title>" + escaped(title) + "</title>");
    if (places)
        for (const ChartDrawing& drawing : figure.drawings()) places->push_back(drawing.place());
    return svg;
}

}  // namespace hibi
