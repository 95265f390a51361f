#include "image/chart_drawing.hpp"

#include <algorithm>
#include <cmath>

namespace hibi {

namespace {

constexpr double mm = 72 / 25.4;
constexpr double height_share = 0.6, most_height = 75 * mm;  // of the axes; a share of the whole width
constexpr double line_width = 1.1, thin_line = 0.5, dot = 1.7, mark_dot = 2.1;
constexpr double tolerance = 0.03;  // what nobody sees on paper
constexpr double row = 1.45;        // from line to line, in text sizes
constexpr double flag_row = 1.25, flag_gap = 0.3;
constexpr double most_name_share = 0.27;  // of the width, for names at the ends of lines
constexpr double ends_at_right = 0.93;    // of the axis

/// Everything that has to find room on an axis.
std::vector<double> values_of(const Chart& chart, std::vector<double> ChartLine::*member) {
    std::vector<double> all;
    for (const ChartLine& line : chart.lines)
        all.insert(all.end(), (line.*member).begin(), (line.*member).end());
    for (const ChartMark& mark : chart.marks) {
        if (member == &ChartLine::x)
            all.push_back(mark.x);
        else if (mark.y)
            all.push_back(*mark.y);
    }
    return all;
}

std::size_t count_of(const ChartLine& line) { return std::min(line.x.size(), line.y.size()); }

}  // namespace

ChartDrawing::ChartDrawing(const Chart& chart, double left, double width, const FigureStyle& style,
                           const Typesetter& type)
    : chart_(chart),
      colours_(theme(style.theme)),
      type_(type),
      look_{.theme = colours_, .text = style.text_pt, .line = thin_line, .crisp = false},
      text_(style.text_pt),
      left_(left),
      width_(width),
      x_(chart.x, values_of(chart, &ChartLine::x), 0.02),
      y_(chart.y, values_of(chart, &ChartLine::y), 0.05) {
    std::vector<const ChartLine*> named;
    for (const ChartLine& line : chart.lines)
        if (!line.label.empty()) named.push_back(&line);
    axes_.height = std::min(height_share * width, most_height);
    y_numbers_ = y_.ticks(std::max(2, static_cast<int>(axes_.height / (2.3 * text_))));
    const TextStyle numbers = number_style(look_);
    double margin = 0, names = 0;
    for (const auto& number : y_numbers_) margin = std::max(margin, type.width(number.text, numbers));
    margin += 0.6 * text_;
    if (named.size() > 1 && name_lines_at_their_ends(named))
        for (const ChartLine* line : named)
            names = std::max(names, type.width(line->label, plain(colours_.text)) + 1.3 * text_);
    else if (named.size() > 1)
        lay_out_legend(named);
    axes_.x = left + margin;
    axes_.width = width - margin - std::max(names, 0.5 * text_);
    // A few values themselves, or as many round numbers as stand apart; half of the last one may reach beyond
    // the axis.
    double taken = 0;
    const auto stand_apart = [&] {
        taken = -1e9;
        for (const auto& number : x_numbers_) {
            if (number.text.empty()) continue;
            const double half = type.width(number.text, numbers) / 2;
            const double at = axes_.x + axes_.width * x_.share(number.value);
            if (at - half < taken + 0.8 * text_) return false;
            taken = at + half;
        }
        return taken > 0;
    };
    x_numbers_ = x_.few_values(values_of(chart, &ChartLine::x));
    for (int most = std::max(2, static_cast<int>(axes_.width / (4 * text_))); !stand_apart() && most >= 2;
         --most)
        x_numbers_ = x_.ticks(most);
    axes_.width -= std::max(0.0, taken - left - width);
    lay_out_flags();
    int rows = title_row_;
    for (const Flag& flag : flags_) rows = std::max(rows, flag.row);
    above_ = (2 + flag_row * rows) * text_;
    head_ = (chart.title.empty() ? 0 : 1.9 * text_) + legend_height_ + above_;
    note_ = type.wrapped(chart.note, plain(colours_.faint_text), width, 8);
    foot_ = 3.2 * text_;
    if (!note_.empty()) foot_ += (0.4 + row * static_cast<double>(note_.size())) * text_;
}

/// Where all lines end at the right, and their names find room below each other.
bool ChartDrawing::name_lines_at_their_ends(const std::vector<const ChartLine*>& named) {
    for (const ChartLine* line : named) {
        std::size_t last = count_of(*line);
        while (last > 0 && !(fits_on(chart_.x, line->x[last - 1]) && fits_on(chart_.y, line->y[last - 1])))
            --last;
        if (last == 0) break;
        const double x = x_.share(line->x[last - 1]), y = y_.share(line->y[last - 1]);
        if (x < ends_at_right || x > 1 || y < 0 || y > 1) break;
        if (type_.width(line->label, plain(colours_.text)) > most_name_share * width_) break;
        ends_.push_back({line, x, 1 - y});
    }
    if (ends_.size() < named.size() || 1.15 * text_ * static_cast<double>(named.size()) > axes_.height) {
        ends_.clear();
        return false;
    }
    std::ranges::stable_sort(ends_, {}, &Name::y);
    return true;
}

void ChartDrawing::lay_out_legend(const std::vector<const ChartLine*>& named) {
    const auto width_of = [&](const ChartLine* line) {
        return std::min(width_, 2.5 * text_ + type_.width(line->label, plain(colours_.text)));
    };
    const double between = 1.2 * text_;
    double all = -between, widest = 0;
    for (const ChartLine* line : named) {
        all += width_of(line) + between;
        widest = std::max(widest, width_of(line));
    }
    const bool in_columns = all > width_;
    double x = 0, y = 0;
    for (const ChartLine* line : named) {
        if (x > 0 && x + width_of(line) > width_) x = 0, y += row * text_;
        legend_.push_back({line, x, y});
        x += (in_columns ? widest : width_of(line)) + between;
    }
    legend_height_ = y + (row + 0.2) * text_;
}

ChartPlace ChartDrawing::place() const {
    return {.axes = axes_,
            .x = x_.range(),
            .y = y_.range(),
            .x_logarithmic = x_.logarithmic(),
            .y_logarithmic = y_.logarithmic()};
}

TextStyle ChartDrawing::plain(const Rgb& colour, Align align) const {
    return {.size = text_, .colour = colour, .align = align};
}

TextStyle ChartDrawing::mark_style() const { return {.size = 0.9 * text_, .colour = colours_.text}; }

Stroke ChartDrawing::stroke_of(const ChartLine& line) const {
    return {.colour = colours_.series[static_cast<std::size_t>(line.colour) % colours_.series.size()],
            .width = line_width,
            .round = !line.dashed,
            .dash = line.dashed ? 3.0 : 0.0};
}

Point ChartDrawing::point(double x, double y) const {
    return {axes_.x + axes_.width * x_.share(x), axes_.y + axes_.height * (1 - y_.share(y))};
}

/// What is seen of a line: without gaps, inside the axes, and no more points than can be told apart.
std::vector<Polyline> ChartDrawing::visible(const ChartLine& line) const {
    constexpr double rounding = 1e-3;
    const PixelRect inside{axes_.x - rounding, axes_.y - rounding, axes_.width + 2 * rounding,
                           axes_.height + 2 * rounding};
    std::vector<Polyline> parts;
    Polyline run;
    const auto end_run = [&] {
        for (const Polyline& part : cut(run, inside)) parts.push_back(simplified(part, tolerance));
        run.clear();
    };
    for (std::size_t k = 0; k < count_of(line); ++k) {
        if (fits_on(chart_.x, line.x[k]) && fits_on(chart_.y, line.y[k]))
            run.push_back(point(line.x[k], line.y[k]));
        else
            end_run();
    }
    end_run();
    return parts;
}

/// Its points, those on top of each other once; or those that stand alone between gaps of a line.
Polyline ChartDrawing::dots(const ChartLine& line) const {
    Polyline at;
    for (const Polyline& part : visible(line))
        if (!line.points && part.size() == 1) at.push_back(part[0]);
    if (!line.points) return at;
    for (std::size_t k = 0; k < count_of(line); ++k) {
        if (!fits_on(chart_.x, line.x[k]) || !fits_on(chart_.y, line.y[k])) continue;
        const double x = x_.share(line.x[k]), y = y_.share(line.y[k]);
        if (x < -1e-9 || x > 1 + 1e-9 || y < -1e-9 || y > 1 + 1e-9) continue;
        const Point p = point(line.x[k], line.y[k]);
        const auto covered = [&](const Point& q) {
            return std::hypot(p[0] - q[0], p[1] - q[1]) < 2 * tolerance;
        };
        if (std::ranges::none_of(at, covered)) at.push_back(p);
    }
    return at;
}

void ChartDrawing::draw_dots(Ink& ink, const Polyline& at, double radius, const Rgb& colour) const {
    if (at.empty()) return;
    for (const Point& p : at) {  // paths without length: dots
        cairo_move_to(ink.path(), p[0], p[1]);
        cairo_line_to(ink.path(), p[0], p[1]);
    }
    ink.stroke({.colour = colour, .width = 2 * radius, .round = true});
}

void ChartDrawing::draw_legend(Ink& ink) const {
    const double top = axes_.y - above_ - legend_height_;
    for (const Name& name : legend_) {
        const double x = left_ + name.x, y = top + name.y + 0.65 * text_;
        const Stroke stroke = stroke_of(*name.line);
        if (name.line->line) ink.line(x, y, x + 2 * text_, y, stroke);
        if (name.line->points) draw_dots(ink, {{x + text_, y}}, dot, stroke.colour);
        const TextStyle style = plain(colours_.text);
        ink.text(type_.shortened(name.line->label, style, width_ - 2.5 * text_), x + 2.5 * text_,
                 y + 0.35 * text_, style);
    }
}

void ChartDrawing::draw_names_at_ends(Ink& ink) const {
    // Pushed apart downwards, then up again from the foot.
    const double apart = 1.15 * text_, foot = axes_.y + axes_.height;
    std::vector<double> middle;
    for (const Name& end : ends_) {
        const double y = axes_.y + axes_.height * end.y;
        middle.push_back(middle.empty() ? y : std::max(y, middle.back() + apart));
    }
    double limit = foot;
    for (std::size_t k = middle.size(); k-- > 0; limit = middle[k] - apart)
        middle[k] = std::min(middle[k], limit);
    for (std::size_t k = 0; k < ends_.size(); ++k) {
        const Stroke stroke = stroke_of(*ends_[k].line);
        const double x0 = axes_.x + axes_.width * ends_[k].x, y0 = axes_.y + axes_.height * ends_[k].y;
        const double x1 = axes_.x + axes_.width + text_;
        if (std::abs(y0 - middle[k]) > 0.15 * text_)
            ink.line(x0 + 0.3 * text_, y0, x1 - 0.15 * text_, middle[k],
                     {.colour = stroke.colour, .width = thin_line});
        ink.text(ends_[k].line->label, x1, middle[k] + 0.35 * text_, plain(stroke.colour));
    }
}

void ChartDrawing::lay_out_flags() {
    const TextStyle style = mark_style();
    for (const ChartMark& mark : chart_.marks) {
        if (mark.y) continue;
        flag_words_.push_back(type_.shortened(mark.label, style, 0.6 * width_));
        flags_.push_back({.x = axes_.x + axes_.width * x_.share(mark.x),
                          .width = type_.width(flag_words_.back(), style) + flag_gap * text_});
    }
    if (!place_flags(flags_, left_, left_ + width_, flag_gap * text_))
        flag_words_.assign(flag_words_.size(), "");  // no room: the lines alone
    // The title of the vertical axis in the lowest row, or else above all.
    const double title_end = left_ + type_.width(y_.title(), plain(colours_.text)) + text_;
    for (const Flag& flag : flags_)
        if (flag.begin() < title_end) title_row_ = 1;
    if (title_row_ > 0)
        for (const Flag& flag : flags_) title_row_ = std::max(title_row_, flag.row + 1);
}

void ChartDrawing::draw_flags(Ink& ink) const {
    const TextStyle style = mark_style();
    for (std::size_t k = 0; k < flags_.size(); ++k) {
        const Flag& flag = flags_[k];
        const double base = axes_.y - (0.55 + flag_row * flag.row) * text_;
        const double top = flag_words_[k].empty() ? axes_.y : base - 0.75 * style.size;
        ink.line(flag.x, top, flag.x, axes_.y + axes_.height,
                 {.colour = colours_.faint_text, .width = thin_line});
        ink.text(flag_words_[k], flag.begin() + (flag.to_left ? 0 : flag_gap * text_), base, style);
    }
}

void ChartDrawing::draw_dot_marks(Ink& ink, FreePlaces& free) const {
    for (const Flag& flag : flags_) free.take(Polyline{{flag.x, axes_.y}, {flag.x, axes_.y + axes_.height}});
    for (const ChartMark& mark : chart_.marks) {
        if (!mark.y) continue;
        const Point p = point(mark.x, *mark.y);
        free.take(PixelRect{p[0] - mark_dot, p[1] - mark_dot, 2 * mark_dot, 2 * mark_dot});
        draw_dots(ink, {p}, mark_dot + 0.6, colours_.background);
        draw_dots(ink, {p}, mark_dot, colours_.text);
    }
    const TextStyle style = mark_style();
    for (const ChartMark& mark : chart_.marks) {
        if (!mark.y) continue;
        const Point p = point(mark.x, *mark.y);
        const std::string words = type_.shortened(mark.label, style, 0.8 * axes_.width);
        const auto box =
            free.nearest(p, type_.width(words, style), 0.95 * style.size, mark_dot + 0.4 * text_);
        if (!box) continue;  // full of data: the dot alone
        free.take(*box);
        const Point q = nearest_point(*box, p);
        const double length = std::hypot(q[0] - p[0], q[1] - p[1]);
        if (length > 1.2 * text_) {
            const auto at = [&](double along) {
                return Point{p[0] + along / length * (q[0] - p[0]), p[1] + along / length * (q[1] - p[1])};
            };
            const Point begin = at(mark_dot + 0.6), end = at(length - 0.15 * text_);
            ink.line(begin[0], begin[1], end[0], end[1], {.colour = colours_.line, .width = thin_line});
            free.take(Polyline{begin, end});
        }
        // Nothing but a grid line can be below the words.
        cairo_rectangle(ink.path(), box->x, box->y, box->width, box->height);
        ink.fill(colours_.background);
        ink.text(words, box->x, box->y + 0.84 * style.size, style);
    }
}

void ChartDrawing::draw(Ink& ink) const {
    TextStyle strong = plain(colours_.text);
    strong.strong = true;
    const double foot = axes_.y + axes_.height;
    if (!chart_.title.empty())
        ink.text(type_.shortened(chart_.title, strong, width_), left_, axes_.y - head_ + text_, strong);
    const TextStyle style = plain(colours_.text);
    ink.text(type_.shortened(y_.title(), style, width_), left_,
             axes_.y - (0.9 + flag_row * title_row_) * text_, style);
    ink.text(type_.shortened(x_.title(), style, axes_.width), axes_.x + axes_.width / 2, foot + 2.8 * text_,
             plain(colours_.text, Align::centre));

    std::vector<Tick> x, y;
    for (const auto& n : x_numbers_) x.push_back({axes_.x + axes_.width * x_.share(n.value), n.text});
    for (const auto& n : y_numbers_) y.push_back({foot - axes_.height * y_.share(n.value), n.text});
    draw_axes(ink, axes_, x, y, look_);
    draw_legend(ink);

    FreePlaces free(axes_, 0.2 * text_);
    bool empty = true;
    for (const ChartLine& line : chart_.lines) {
        const Stroke stroke = stroke_of(line);
        const Polyline points = dots(line);
        for (const Point& p : points) free.take(PixelRect{p[0] - dot, p[1] - dot, 2 * dot, 2 * dot});
        empty = empty && points.empty();
        if (line.line) {
            for (const Polyline& part : visible(line)) {
                empty = false;
                free.take(part);
                for (const Point& p : part) {
                    if (&p == &part[0])
                        cairo_move_to(ink.path(), p[0], p[1]);
                    else
                        cairo_line_to(ink.path(), p[0], p[1]);
                }
            }
            ink.stroke(stroke);
        }
        draw_dots(ink, points, dot, stroke.colour);
    }
    if (empty)
        ink.text("no data", axes_.x + axes_.width / 2, axes_.y + axes_.height / 2,
                 plain(colours_.faint_text, Align::centre));
    draw_flags(ink);
    draw_dot_marks(ink, free);
    draw_names_at_ends(ink);
    double below = foot + 4.4 * text_;
    for (const std::string& words : note_) {
        ink.text(words, left_, below, plain(colours_.faint_text));
        below += row * text_;
    }
}

}  // namespace hibi
