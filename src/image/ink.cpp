#include "image/ink.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <span>

namespace hibi {

namespace {

std::string web_colour(const Rgb& colour) {
    std::string text = "#";
    for (const float part : colour) text += fmt::format("{:02x}", std::lround(255 * part));
    return text;
}

/// As short as it can be written: "12.5", "-.03".
void add_number(std::string& text, long hundredths, bool separate) {
    if (hundredths < 0)
        text += '-';
    else if (separate)
        text += ' ';
    const long size = std::labs(hundredths), rest = size % 100;
    if (size >= 100 || rest == 0) text += std::to_string(size / 100);
    if (rest > 0) text += rest % 10 == 0 ? fmt::format(".{}", rest / 10) : fmt::format(".{:02}", rest);
}

}  // namespace

std::string xml_escaped(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '&')
            result += "&amp;";
        else if (c == '<')
            result += "&lt;";
        else if (c == '>')
            result += "&gt;";
        else if (c == '"')
            result += "&quot;";
        else
            result += c;
    }
    return result;
}

Ink::Ink(std::string& svg, const Typesetter& type)
    : pen_(nullptr),
      type_(type),
      svg_(&svg),
      scratch_(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1)),
      scratch_pen_(pen_on(scratch_)) {
    pen_ = scratch_pen_.get();
}

/// The pen's path in the words of SVG; every step but the first is relative to the rounded point before.
/// Leaves no path behind.
std::string Ink::take_path() {
    struct Release {
        void operator()(cairo_path_t* path) const { cairo_path_destroy(path); }
    };
    const std::unique_ptr<cairo_path_t, Release> path(cairo_copy_path(pen_));
    cairo_new_path(pen_);
    std::string text;
    char last = 0;
    std::array<long, 2> at{0, 0}, begin{0, 0};
    for (int i = 0; i < path->num_data; i += path->data[i].header.length) {
        const std::span<const cairo_path_data_t> step(path->data + i, path->data[i].header.length);
        const cairo_path_data_type_t kind = step[0].header.type;
        if (kind == CAIRO_PATH_CLOSE_PATH) {
            text += last = 'z';
            at = begin;
            continue;
        }
        // Cairo ends a closed path with a move that starts nothing.
        if (kind == CAIRO_PATH_MOVE_TO && i + path->data[i].header.length >= path->num_data) break;
        const char letter = text.empty()                 ? 'M'
                            : kind == CAIRO_PATH_MOVE_TO ? 'm'
                            : kind == CAIRO_PATH_LINE_TO ? 'l'
                                                         : 'c';
        bool separate = letter == last && letter != 'm';
        if (!separate) text += last = letter;
        const std::array<long, 2> from = at;
        for (std::size_t k = 1; k < step.size(); ++k) {
            at = {std::lround(100 * step[k].point.x), std::lround(100 * step[k].point.y)};
            add_number(text, at[0] - from[0], separate);
            add_number(text, at[1] - from[1], true);
            separate = true;
        }
        if (kind == CAIRO_PATH_MOVE_TO) begin = at;
    }
    return text;
}

void Ink::stroke(const Stroke& how) {
    if (svg_) {
        *svg_ += fmt::format(
            "<path fill=\"none\" stroke=\"{}\" stroke-width=\"{:.3g}\"{}{} d=\"{}\"/>\n",
            web_colour(how.colour), how.width,
            how.round ? " stroke-linecap=\"round\" stroke-linejoin=\"round\"" : "",
            how.dash > 0 ? fmt::format(" stroke-dasharray=\"{:.3g} {:.3g}\"", how.dash, 2 * how.dash / 3)
                         : "",
            take_path());
        return;
    }
    const double dashes[] = {how.dash, 2 * how.dash / 3};
    cairo_set_dash(pen_, dashes, how.dash > 0 ? 2 : 0, 0);
    cairo_set_line_cap(pen_, how.round ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
    cairo_set_line_join(pen_, how.round ? CAIRO_LINE_JOIN_ROUND : CAIRO_LINE_JOIN_MITER);
    set_colour(pen_, how.colour);
    cairo_set_line_width(pen_, how.width);
    cairo_stroke(pen_);
}

void Ink::fill(const Rgb& colour) {
    if (svg_) {
        *svg_ += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", web_colour(colour), take_path());
        return;
    }
    set_colour(pen_, colour);
    cairo_fill(pen_);
}

void Ink::line(double x0, double y0, double x1, double y1, const Stroke& how) {
    cairo_move_to(pen_, x0, y0);
    cairo_line_to(pen_, x1, y1);
    stroke(how);
}

void Ink::text(const std::string& words, double x, double y, const TextStyle& style) {
    if (!svg_) return type_.draw(pen_, words, x, y, style);
    const std::string colour = web_colour(style.colour);
    std::string plain, thick;
    double stroke_width = 0;
    type_.outlines(pen_, words, x, y, style, [&](double thicker) {
        stroke_width = std::max(stroke_width, thicker);
        (thicker > 0 ? thick : plain) += take_path();
    });
    if (!plain.empty())
        *svg_ += fmt::format("<path aria-label=\"{}\" fill=\"{}\" d=\"{}\"/>\n", xml_escaped(words), colour,
                             plain);
    if (!thick.empty())
        *svg_ += fmt::format(
            "<path aria-label=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.3g}\" d=\"{}\"/>\n",
            xml_escaped(words), colour, colour, stroke_width, thick);
}

}  // namespace hibi
