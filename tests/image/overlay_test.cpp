#include "image/overlay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "image/layout.hpp"

namespace hibi {
namespace {

OverlayContent content() {
    OverlayContent c;
    c.title = "Bending failure of a cantilever plate";
    c.subtitle = "800 particles · 3022 bonds";
    c.colour_bar = {"Bond strain", "", -0.1, 0.1, "diverging"};
    c.has_breaks = true;
    c.load_title = "Load";
    c.load_unit = "N";
    c.load_max = 3.6e7;
    c.time_end = 18;
    c.time_resolution = 0.01;
    c.curve = {.x_title = "Displacement", .x_unit = "m", .y_title = "Load", .y_unit = "N"};
    for (int k = 0; k <= 100; ++k) {
        c.curve.time.push_back(0.18 * k);
        c.curve.x.push_back(0.08 * k);
        c.curve.y.push_back(3.6e5 * k);
        c.curve.broken.push_back(k > 90 ? k - 90 : 0);
    }
    return c;
}

Image blank(const View& view) {
    Image image(view.width, view.height);
    const Rgb& b = theme(view.theme).background;
    for (int i = 0; i < view.width * view.height; ++i)
        for (int c = 0; c < 3; ++c)
            image.bgra[4 * i + c] = static_cast<std::uint8_t>(std::lround(255 * b[2 - c]));
    return image;
}

Image drawn(const View& view, const OverlayFrame& frame, const OverlayContent& what = content()) {
    Image image = blank(view);
    Overlay(view, what).draw(image, frame);
    return image;
}

bool same_pixel(const Image& a, const Image& b, int x, int y) {
    return std::equal(a.pixel(x, y), a.pixel(x, y) + 3, b.pixel(x, y));
}

/// Pixels that differ inside the rectangle.
int differences(const Image& a, const Image& b, int x0, int y0, int x1, int y1) {
    int count = 0;
    for (int y = std::max(0, y0); y < std::min(a.height, y1); ++y)
        for (int x = std::max(0, x0); x < std::min(a.width, x1); ++x) count += !same_pixel(a, b, x, y);
    return count;
}

TEST(Overlay, TheSamePixelsEveryTime) {
    const View view;
    const OverlayFrame frame{
        .time = 9, .load = 1.8e7, .broken = 3, .event = "First break", .pixels_per_metre = 30};
    EXPECT_EQ(pixel_hash(drawn(view, frame)), pixel_hash(drawn(view, frame)));
    const Overlay overlay(view, content());
    Image first = blank(view), second = blank(view);
    overlay.draw(first, frame);
    Image between = blank(view);
    overlay.draw(between, {.time = 1, .load = 2e6, .pixels_per_metre = 30});
    overlay.draw(second, frame);
    EXPECT_EQ(pixel_hash(first), pixel_hash(second));
}

TEST(Overlay, NothingReachesTheEdgeOfThePictureEvenWithLongTexts) {
    OverlayContent c = content();
    c.title =
        "A very long title about the bending failure of a cantilever plate, 片持ち平板の曲げ破壊, that goes "
        "on";
    c.subtitle = c.title + c.title;
    c.colour_bar.title = "Largest principal stress of everything";
    c.load_max = 9.99e20;
    for (const auto& [w, h] :
         {std::pair(1920, 1080), {1080, 1080}, {1080, 1920}, {640, 360}, {320, 180}, {64, 48}})
        for (const std::string& name : theme_names()) {
            View view;
            view.width = w;
            view.height = h;
            view.theme = name;
            const OverlayFrame frame{.time = 17.99,
                                     .load = -9.99e20,
                                     .broken = 1234567,
                                     .event = "First break",
                                     .speed = 0.01,
                                     .pixels_per_metre = 1};
            const Image image = drawn(view, frame, c), empty = blank(view);
            ASSERT_GT(differences(image, empty, 0, 0, w, h), w >= 320 ? 500 : -1);
            const int edge = 3;
            // Beside the title, where what is too long would be cut.
            const PixelRect title = lay_out(w, h, {}).title;
            const int beside = static_cast<int>(title.x + title.width) + 2;
            EXPECT_EQ(
                differences(image, empty, beside, 0, beside + 5, static_cast<int>(title.y + title.height)),
                0);
            EXPECT_EQ(differences(image, empty, 0, 0, w, edge), 0) << w << "x" << h;
            EXPECT_EQ(differences(image, empty, 0, h - edge, w, h), 0) << w << "x" << h;
            EXPECT_EQ(differences(image, empty, 0, 0, edge, h), 0) << w << "x" << h;
            EXPECT_EQ(differences(image, empty, w - edge, 0, w, h), 0) << w << "x" << h;
        }
}

TEST(Overlay, HatchesUnderAFewSmallParticlesAreNoLongerThanWhatTheyHangOn) {
    const View view;
    // How far below the particles' edge a clamp of so many, 6 pixels wide each, is drawn (pixels).
    const auto depth = [&](int particles) {
        Symbol clamp;
        clamp.kind = Symbol::Kind::clamp;
        clamp.radius = 3;
        clamp.outward = {0, 1};
        for (int k = 0; k < particles; ++k) clamp.points.push_back({600.0 + 6 * k, 500});
        OverlayFrame frame{.pixels_per_metre = 30};
        const Image without = drawn(view, frame);
        frame.symbols.push_back(clamp);
        const Image with = drawn(view, frame);
        int lowest = 503;
        for (int y = 503; y < 560; ++y)
            if (differences(with, without, 400, y, 1200, y + 1) > 0) lowest = y;
        return lowest - 503;
    };
    const double unit = symbol_unit(view);
    EXPECT_NEAR(depth(40), 13 * unit, 2.5);
    EXPECT_NEAR(depth(8), 13 * unit, 2.5);
    EXPECT_NEAR(depth(2), 0.45 * 12, 2.5);
}

TEST(Overlay, LeavesTheBodyAlone) {
    const View view;
    const PixelRect plot = Overlay(view, content()).plot();
    const Image image =
        drawn(view, {.time = 9, .load = 1.8e7, .event = "First break", .pixels_per_metre = 30});
    EXPECT_EQ(differences(image, blank(view), static_cast<int>(plot.x) + 1, static_cast<int>(plot.y) + 1,
                          static_cast<int>(plot.x + plot.width), static_cast<int>(plot.y + plot.height)),
              0);
}

TEST(Overlay, ARunningTimeChangesItsDigitsOnly) {
    View view;
    view.show = {"title", "time", "scale_bar"};
    const Image a = drawn(view, {.time = 11.11, .pixels_per_metre = 30});
    const Image b = drawn(view, {.time = 12.11, .pixels_per_metre = 30});
    // Only the second digit differs: a box as wide as one digit.
    int left = view.width, right = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x)
            if (!same_pixel(a, b, x, y)) left = std::min(left, x), right = std::max(right, x);
    ASSERT_LT(left, right);
    EXPECT_LT(right - left, lay_out(view.width, view.height, {}).text * 1.45);
}

TEST(Overlay, TheCurveGrowsWithTime) {
    View view;
    const PixelRect r = lay_out(view.width, view.height, {}).curve;
    const auto in_curve = [&](double time, double later) {
        return differences(drawn(view, {.time = time}), drawn(view, {.time = later}), static_cast<int>(r.x),
                           static_cast<int>(r.y), static_cast<int>(r.x + r.width),
                           static_cast<int>(r.y + r.height));
    };
    EXPECT_GT(in_curve(4, 12), 200);
    EXPECT_GT(in_curve(18, 25), 20);  // past the last point the dot is gone ...
    EXPECT_EQ(in_curve(25, 40), 0);   // ... and the curve stands still
}

TEST(Overlay, AnArrowTouchesItsParticleFromOutsideAndAClampLiesBehindIt) {
    View view;
    view.show = {};
    OverlayFrame frame;
    Symbol arrow, clamp;
    arrow.kind = Symbol::Kind::arrow;
    arrow.points = {{800, 500}};
    arrow.radius = 10;
    arrow.direction = {0, 1};  // down
    clamp.points = {{300, 400}, {300, 420}, {300, 440}};
    clamp.radius = 10;
    clamp.outward = {-1, 0};
    frame.symbols = {arrow, clamp};
    const Image image = drawn(view, frame, {}), empty = blank(view);
    EXPECT_GT(differences(image, empty, 780, 400, 820, 490), 100);  // above the particle
    EXPECT_EQ(differences(image, empty, 780, 490, 820, 600), 0);    // not on or below it
    EXPECT_GT(differences(image, empty, 790, 484, 810, 490), 0);    // close to its edge
    EXPECT_GT(differences(image, empty, 260, 390, 292, 450), 100);  // left of the edge at 290
    EXPECT_EQ(differences(image, empty, 293, 370, 340, 470), 0);
    frame.symbols[0].pulls = true;
    const Image pulled = drawn(view, frame, {});
    EXPECT_EQ(differences(pulled, empty, 780, 400, 820, 510), 0);
    EXPECT_GT(differences(pulled, empty, 780, 510, 820, 620), 100);
    frame.symbols[0].size = 0;
    EXPECT_EQ(differences(drawn(view, frame, {}), empty, 700, 300, 900, 700), 0);
}

TEST(Overlay, RollersAreCirclesOnAGround) {
    View view;
    view.show = {};
    Symbol roller;
    roller.kind = Symbol::Kind::roller;
    roller.points = {{500, 500}, {520, 500}, {540, 500}, {560, 500}};
    roller.radius = 10;
    roller.outward = {0, 1};
    OverlayFrame frame;
    frame.symbols = {roller};
    const Image image = drawn(view, frame, {}), empty = blank(view);
    EXPECT_EQ(differences(image, empty, 480, 480, 580, 509), 0);
    const int reach = static_cast<int>(symbol_reach(Symbol::Kind::roller, view));
    EXPECT_GT(differences(image, empty, 480, 510, 580, 511 + reach), 300);
    EXPECT_EQ(differences(image, empty, 400, 511 + reach, 700, 700), 0);
}

TEST(Overlay, AMissingGlyphInTheTitleIsAnError) {
    OverlayContent c = content();
    c.title = "Crack 😀";
    EXPECT_THROW(Overlay(View{}, c), std::runtime_error);
}

TEST(Overlay, EventAndSlowMotionAreShownAndFade) {
    const View view;
    const OverlayFrame plain{.time = 9, .load = 1.8e7, .pixels_per_metre = 30};
    OverlayFrame event = plain, faded = plain, slow = plain;
    event.event = faded.event = "First break";
    faded.event_strength = 0;
    slow.speed = 0.05;
    EXPECT_NE(pixel_hash(drawn(view, event)), pixel_hash(drawn(view, plain)));
    EXPECT_NE(pixel_hash(drawn(view, slow)), pixel_hash(drawn(view, plain)));
    EXPECT_EQ(pixel_hash(drawn(view, faded)), pixel_hash(drawn(view, plain)));
}

}  // namespace
}  // namespace hibi
