#include "image/inset.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "image/axes.hpp"

namespace hibi {

namespace {

/// Smallest and largest finite value, zero included.
std::array<double, 2> range_of(const std::vector<double>& values) {
    std::array<double, 2> range{0, 0};
    for (const double v : values)
        if (std::isfinite(v)) range = {std::min(range[0], v), std::max(range[1], v)};
    return range;
}

std::array<double, 2> joined(const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return {std::min(a[0], b[0]), std::max(a[1], b[1])};
}

double magnitude(const std::array<double, 2>& range) { return std::max(-range[0], range[1]); }

}  // namespace

Inset::Inset(const InsetCurve& curve, const PixelRect& rect, const Theme& theme, const Typesetter& type,
             double text, double unit)
    : theme_(theme), type_(type), text_(text), unit_(unit), rect_(rect) {
    auto x_range = range_of(curve.x), y_range = range_of(curve.y);
    for (const InsetCurve::Other& other : curve.others) {
        x_range = joined(x_range, range_of(other.x));
        y_range = joined(y_range, range_of(other.y));
    }
    const Scale x_scale = scale_for(magnitude(x_range), curve.x_unit);
    const Scale y_scale = scale_for(magnitude(y_range), curve.y_unit);
    x_title_ = with_unit(curve.x_title, x_scale);
    y_title_ = with_unit(curve.y_title, y_scale);
    const auto widened = [](double range, double factor) { return range * factor * 1.04; };
    x_low_ = widened(x_range[0], x_scale.factor);
    x_high_ = widened(x_range[1], x_scale.factor);
    y_low_ = widened(y_range[0], y_scale.factor);
    y_high_ = widened(y_range[1], y_scale.factor);
    if (x_high_ <= x_low_) x_high_ = x_low_ + 1;
    if (y_high_ <= y_low_) y_high_ = y_low_ + 1;

    const double most_broken = curve.broken.empty() ? 0 : range_of(curve.broken)[1];
    if (most_broken > 0) broken_max_ = fmt::format("{}", most_broken);
    const TextStyle small{.size = 0.9 * text};
    const double top = 2.3 * text, bottom = 3.0 * text;
    y_ticks_ = round_ticks(y_low_, y_high_,
                           std::max(2, static_cast<int>((rect.height - top - bottom) / (2.6 * text))));
    double left = 0;
    for (const double tick : y_ticks_.at)
        left = std::max(left, type.width(decimal(tick, y_ticks_.decimals), small) + 0.6 * text);
    const double right =
        std::max(0.6 * text, broken_max_.empty() ? 0 : type.width(broken_max_, small) + 0.5 * text);
    axes_ = {rect.x + left, rect.y + top, rect.width - left - right, rect.height - top - bottom};
    x_ticks_ = round_ticks(x_low_, x_high_, std::max(2, static_cast<int>(axes_.width / (3.0 * text))));

    const auto pixel_x = [&](double x) {
        return axes_.x + axes_.width * (x * x_scale.factor - x_low_) / (x_high_ - x_low_);
    };
    const auto pixel_y = [&](double y) {
        return axes_.y + axes_.height * (1 - (y * y_scale.factor - y_low_) / (y_high_ - y_low_));
    };
    for (const InsetCurve::Other& other : curve.others) {
        Line& line = others_.emplace_back();
        for (std::size_t i = 0; i < other.time.size(); ++i)
            if (std::isfinite(other.x[i]) && std::isfinite(other.y[i]))
                line.add(other.time[i], pixel_x(other.x[i]), pixel_y(other.y[i]), i + 1 == other.time.size());
    }
    const int count = static_cast<int>(curve.time.size());
    for (int i = 0; i < count; ++i) {
        if (!std::isfinite(curve.x[i]) || !std::isfinite(curve.y[i])) continue;
        const double px = pixel_x(curve.x[i]);
        line_.add(curve.time[i], px, pixel_y(curve.y[i]), i == count - 1);
        if (most_broken > 0)
            broken_.add(curve.time[i], px, axes_.y + axes_.height * (1 - curve.broken[i] / most_broken),
                        i == count - 1);
    }
}

void Inset::Line::add(double t, double x, double y, bool last) {
    if (!points.empty() && !last && std::hypot(x - points.back()[0], y - points.back()[1]) < 0.4) return;
    time.push_back(t);
    points.push_back({x, y});
}

void Inset::Line::draw(cairo_t* cairo, double now, double dot) const {
    const int upto = static_cast<int>(std::ranges::upper_bound(time, now) - time.begin());
    if (upto == 0) return;
    std::array<double, 2> end = points[upto - 1];
    if (upto < static_cast<int>(points.size())) {  // to the very moment, so that the dot moves evenly
        const double share = (now - time[upto - 1]) / (time[upto] - time[upto - 1]);
        end[0] += share * (points[upto][0] - end[0]);
        if (dot > 0) end[1] += share * (points[upto][1] - end[1]);  // a count jumps, it does not grow
    }
    for (int i = 0; i < upto; ++i) cairo_line_to(cairo, points[i][0], points[i][1]);
    cairo_line_to(cairo, end[0], end[1]);
    cairo_stroke(cairo);
    if (dot <= 0 || now > time.back()) return;  // the curve ends with the separation, the load goes on
    cairo_arc(cairo, end[0], end[1], dot, 0, 6.283185307179586);
    cairo_fill(cairo);
}

void Inset::draw_axes(cairo_t* cairo) const {
    TextStyle style{.size = text_, .colour = theme_.curve};
    type_.draw(cairo, y_title_, rect_.x, rect_.y + text_, style);
    if (!broken_max_.empty()) {
        style.colour = theme_.curve_second;
        style.align = Align::right;
        type_.draw(cairo, "Broken bonds", rect_.x + rect_.width, rect_.y + text_, style);
        style.size = 0.9 * text_;
        type_.draw(cairo, broken_max_, rect_.x + rect_.width, axes_.y + 0.33 * style.size, style);
    }
    std::vector<Tick> x, y;
    for (const double tick : x_ticks_.at)
        x.push_back(
            {axes_.x + axes_.width * (tick - x_low_) / (x_high_ - x_low_), decimal(tick, x_ticks_.decimals)});
    for (const double tick : y_ticks_.at)
        y.push_back({axes_.y + axes_.height * (1 - (tick - y_low_) / (y_high_ - y_low_)),
                     decimal(tick, y_ticks_.decimals)});
    const AxesStyle look{.theme = theme_, .text = text_};
    Ink ink(cairo, type_);
    hibi::draw_axes(ink, axes_, x, y, look);
    style = number_style(look);
    style.align = Align::centre;
    style.size = text_;
    type_.draw(cairo, x_title_, axes_.x + axes_.width / 2, rect_.y + rect_.height - 0.1 * text_, style);
}

void Inset::draw_lines(cairo_t* cairo, double time) const {
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_set_line_width(cairo, std::max(1.0, 1.5 * unit_));
    set_colour(cairo, theme_.curve_second);
    broken_.draw(cairo, time, 0);
    cairo_set_line_width(cairo, std::max(1.2, 2 * unit_));
    for (std::size_t k = others_.size(); k-- > 0;) {
        set_colour(cairo, theme_.series[(k + 1) % theme_.series.size()]);
        others_[k].draw(cairo, time, std::max(2.2, 4 * unit_));
    }
    set_colour(cairo, theme_.curve);
    line_.draw(cairo, time, std::max(2.2, 4 * unit_));
}

}  // namespace hibi
