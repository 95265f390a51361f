#include "image/scales.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "image/canvas.hpp"
#include "image/text.hpp"

namespace hibi {
namespace {

/// Sum of what is darker than white paper, inside the rectangle, in whole black pixels.
double ink(const Image& image, int x0, int y0, int x1, int y1) {
    double sum = 0;
    for (int y = std::max(0, y0); y < std::min(image.height, y1); ++y)
        for (int x = std::max(0, x0); x < std::min(image.width, x1); ++x)
            sum += 1 - image.pixel(x, y)[1] / 255.0;
    return sum;
}

// The margin of a figure is narrower than half of such a number, which stands centred under the bar's end.
TEST(FigureScales, TheNumberAtTheBeginningOfTheColourBarIsWhole) {
    const FigureStyle style{.theme = "print"};
    const double text = style.text();
    const TextStyle words{.size = text, .colour = theme(style.theme).text, .tabular = true};
    const std::string number = "\u22121000";
    const Typesetter type;
    const int wide = static_cast<int>(std::ceil(type.width(number, words))) + 2;
    ASSERT_LT(style.margin(), wide / 2.0);

    Image alone(3 * wide, static_cast<int>(3 * text));
    std::ranges::fill(alone.bgra, std::uint8_t{255});
    {
        const CairoSurface surface = surface_on(alone);
        type.draw(pen_on(surface).get(), number, wide, 2 * text, words);
        cairo_surface_flush(surface.get());
    }
    const double whole = ink(alone, 0, 0, alone.width, alone.height);
    ASSERT_GT(whole, 50);

    const Image picture(style.width(), 10);
    const FigureScales scales{.colours = ColourBar{"Stress", "", -1000, 1000, "inferno"}};
    const Image image = with_scales(picture, scales, style);
    // Below the ticks of the bar, as far as the first number reaches.
    const double foot = picture.height + 0.4 * text + 2.6 * text;
    EXPECT_NEAR(ink(image, 0, static_cast<int>(foot + 0.5 * text), wide, image.height) / whole, 1, 0.05);
}

}  // namespace
}  // namespace hibi
