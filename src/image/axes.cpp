#include "image/axes.hpp"

namespace hibi {

TextStyle number_style(const AxesStyle& style) {
    return {.size = 0.9 * style.text, .colour = style.theme.faint_text};
}

void draw_axes(Ink& ink, const PixelRect& axes, const std::vector<Tick>& x, const std::vector<Tick>& y,
               const AxesStyle& style) {
    const auto at = [&](double v) { return style.crisp ? crisp(v) : v; };
    const Stroke grid{style.theme.grid, style.line}, line{style.theme.line, style.line};
    const double foot = axes.y + axes.height, right = axes.x + axes.width;
    TextStyle numbers = number_style(style);
    numbers.align = Align::right;
    for (const Tick& tick : y) {
        if (tick.text.empty()) {
            ink.line(axes.x - 0.2 * style.text, at(tick.at), axes.x, at(tick.at), line);
            continue;
        }
        ink.line(axes.x, at(tick.at), right, at(tick.at), grid);
        ink.text(tick.text, axes.x - 0.5 * style.text, tick.at + 0.35 * numbers.size, numbers);
    }
    numbers.align = Align::centre;
    for (const Tick& tick : x) {
        const double length = (tick.text.empty() ? 0.2 : 0.3) * style.text;
        ink.line(at(tick.at), foot, at(tick.at), foot + length, line);
        if (!tick.text.empty()) ink.text(tick.text, tick.at, foot + numbers_below * style.text, numbers);
    }
    ink.line(at(axes.x), axes.y, at(axes.x), foot, line);
    ink.line(axes.x, at(foot), right, at(foot), line);
}

}  // namespace hibi
