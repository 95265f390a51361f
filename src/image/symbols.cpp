#include "image/symbols.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "image/layout.hpp"

namespace hibi {

namespace {

using Point = std::array<double, 2>;

Point moved(const Point& p, const Point& along, double distance) {
    return {p[0] + along[0] * distance, p[1] + along[1] * distance};
}

double distance(const Point& a, const Point& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

/// A line that can be asked for the point at a distance from its beginning.
struct Path {
    std::vector<Point> points;
    std::vector<double> length;  // from the beginning

    explicit Path(std::vector<Point> corners) : points(std::move(corners)), length{0} {
        for (std::size_t i = 1; i < points.size(); ++i)
            length.push_back(length.back() + distance(points[i - 1], points[i]));
    }
    Point at(double s) const {
        const auto after = std::ranges::upper_bound(length, s) - length.begin();
        const int i = std::clamp(static_cast<int>(after), 1, static_cast<int>(points.size()) - 1);
        const double share = (s - length[i - 1]) / std::max(length[i] - length[i - 1], 1e-9);
        return {points[i - 1][0] + share * (points[i][0] - points[i - 1][0]),
                points[i - 1][1] + share * (points[i][1] - points[i - 1][1])};
    }
};

/// The outer edge of the outline's particles, `away` beyond them, begun and ended at the edges of the last
/// ones.
Path edge(const Symbol& symbol, double away) {
    std::vector<Point> points;
    for (const Point& p : symbol.points) points.push_back(moved(p, symbol.outward, symbol.radius + away));
    const auto extended = [&](const Point& end, const Point& before) {
        const double d = distance(before, end);
        const Point tangent = d > 1e-9 ? Point{(end[0] - before[0]) / d, (end[1] - before[1]) / d}
                                       : Point{-symbol.outward[1], symbol.outward[0]};
        return moved(end, tangent, symbol.radius);
    };
    if (points.size() == 1) points.push_back(points[0]);
    const Point first = extended(points[0], points[1]);
    const Point last = points[1] == points[0]
                           ? moved(points[0], {symbol.outward[1], -symbol.outward[0]}, symbol.radius)
                           : extended(points.back(), points[points.size() - 2]);
    points.front() = first;
    points.back() = last;
    return Path(points);
}

/// The ground: a line with slanted strokes behind it, spread evenly so that they begin and end alike.
void draw_ground(cairo_t* cairo, const Symbol& symbol, const Path& path, double unit, double depth,
                 int least_strokes = 2) {
    const double total = path.length.back();
    cairo_set_line_width(cairo, std::max(1.0, 1.3 * unit));
    const int strokes =
        std::max(least_strokes, static_cast<int>(std::lround(total / std::max(4.0, 9 * unit))));
    const Point tangent = {-symbol.outward[1], symbol.outward[0]};
    for (int k = 0; k < strokes; ++k) {
        const Point root = path.at(total * (k + 0.5) / strokes);
        const Point tip = moved(moved(root, symbol.outward, depth), tangent, 0.8 * depth);
        stroke_line(cairo, root[0], root[1], tip[0], tip[1]);
    }
    cairo_set_line_width(cairo, std::max(1.2, 2.4 * unit));
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    for (const Point& p : path.points) cairo_line_to(cairo, p[0], p[1]);
    cairo_stroke(cairo);
}

/// Under a support of a few small particles full strokes would be longer than what they hang on: there they
/// are shorter, and three.
void draw_clamp(cairo_t* cairo, const Symbol& symbol, double unit) {
    const Path path = edge(symbol, 0);
    const double depth = hatch_depth * unit, most = std::max(3.0, 0.45 * path.length.back());
    draw_ground(cairo, symbol, path, unit, std::min(depth, most), depth > most ? 3 : 2);
}

void draw_rollers(cairo_t* cairo, const Symbol& symbol, double unit) {
    const double radius = std::max(2.0, roller_radius * unit);
    const Path path = edge(symbol, radius + unit);
    const double total = path.length.back();
    cairo_set_line_width(cairo, std::max(1.0, 1.6 * unit));
    const int circles = std::max(1, static_cast<int>(total / (3.2 * radius)));
    for (int k = 0; k < circles; ++k) {
        const Point centre = path.at(total * (k + 0.5) / circles);
        cairo_new_sub_path(cairo);
        cairo_arc(cairo, centre[0], centre[1], radius, 0, 6.283185307179586);
        cairo_stroke(cairo);
    }
    draw_ground(cairo, symbol, edge(symbol, 2 * radius + 2 * unit), unit, 0.6 * hatch_depth * unit);
}

void draw_arrows(cairo_t* cairo, const Symbol& symbol, double unit) {
    const double length = arrow_length * unit * std::min(symbol.size, 1.0);
    if (length < 2) return;
    const double head = std::min(14 * unit, 0.7 * length), half_width = 0.4 * head;
    const double gap = symbol.radius + std::max(1.0, 1.5 * unit);
    const Point& d = symbol.direction;
    std::vector<Point> tails;
    cairo_set_line_width(cairo, std::max(1.2, 3 * unit));
    for (const Point& p : symbol.points) {
        const Point tip = moved(p, d, symbol.pulls ? gap + length : -gap);
        const Point tail = moved(tip, d, -length), neck = moved(tip, d, -head);
        stroke_line(cairo, tail[0], tail[1], neck[0] + 0.1 * head * d[0], neck[1] + 0.1 * head * d[1]);
        cairo_move_to(cairo, tip[0], tip[1]);
        cairo_line_to(cairo, neck[0] - half_width * d[1], neck[1] + half_width * d[0]);
        cairo_line_to(cairo, neck[0] + half_width * d[1], neck[1] - half_width * d[0]);
        cairo_close_path(cairo);
        cairo_fill(cairo);
        tails.push_back(tail);
    }
    if (tails.size() > 1) {
        cairo_set_line_width(cairo, std::max(1.0, 1.8 * unit));
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_SQUARE);
        for (const Point& tail : tails) cairo_line_to(cairo, tail[0], tail[1]);
        cairo_stroke(cairo);
        cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
    }
}

void draw_notch(cairo_t* cairo, const Symbol& symbol, double unit) {
    cairo_set_line_width(cairo, std::max(1.0, 2.5 * unit));
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_ROUND);
    for (const Point& p : symbol.points) cairo_line_to(cairo, p[0], p[1]);
    cairo_stroke(cairo);
    cairo_set_line_cap(cairo, CAIRO_LINE_CAP_BUTT);
}

Rgb colour_of(Symbol::Kind kind, const Theme& theme) {
    if (kind == Symbol::Kind::arrow) return theme.load;
    return theme.support;
}

}  // namespace

double symbol_unit(const View& view) { return lay_out(view.width, view.height, {}).unit * view.stroke; }

double symbol_reach(Symbol::Kind kind, const View& view) {
    const double unit = symbol_unit(view);
    const double room = 3 * unit + 2;
    if (kind == Symbol::Kind::arrow) return arrow_length * unit + room;
    if (kind == Symbol::Kind::notch) return 0;
    if (kind == Symbol::Kind::clamp) return hatch_depth * unit + room;
    return 2 * std::max(2.0, roller_radius * unit) + 0.6 * hatch_depth * unit + room;
}

void draw_symbol(cairo_t* cairo, const Symbol& symbol, const Theme& theme, double unit) {
    if (symbol.points.empty()) return;
    set_colour(cairo, colour_of(symbol.kind, theme));
    if (symbol.kind == Symbol::Kind::notch) draw_notch(cairo, symbol, unit);
    if (symbol.kind == Symbol::Kind::arrow) draw_arrows(cairo, symbol, unit);
    if (symbol.kind == Symbol::Kind::roller) draw_rollers(cairo, symbol, unit);
    if (symbol.kind == Symbol::Kind::clamp) draw_clamp(cairo, symbol, unit);
}

}  // namespace hibi
