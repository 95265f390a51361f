#include "image/ink.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace hibi {
namespace {

TEST(Ink, WritesPathsAsShortAsTheyCanBe) {
    const Typesetter type;
    std::string svg;
    Ink ink(svg, type);
    cairo_t* path = ink.path();
    cairo_move_to(path, 10, 20.5);
    cairo_line_to(path, 10.25, 20);
    cairo_line_to(path, 9.25, 20.5);
    cairo_close_path(path);
    ink.fill({1, 0, 0});
    EXPECT_EQ(svg, "<path fill=\"#ff0000\" d=\"M10 20.5l.25-.5-1 .5z\"/>\n");
    svg.clear();
    ink.line(1, 2, 1, 2, {.colour = {0, 0, 1}, .width = 3, .round = true});  // a dot
    EXPECT_EQ(svg,
              "<path fill=\"none\" stroke=\"#0000ff\" stroke-width=\"3\" stroke-linecap=\"round\" "
              "stroke-linejoin=\"round\" d=\"M1 2l0 0\"/>\n");
}

TEST(Ink, RoundingDoesNotAddUp) {
    const Typesetter type;
    std::string svg;
    Ink ink(svg, type);
    for (int k = 0; k <= 1000; ++k) cairo_line_to(ink.path(), k / 256.0, k % 2);  // 1/256: Cairo's own steps
    ink.stroke({});
    std::string steps;
    for (const char c : svg.substr(svg.find("d=\"M0 0l") + 8))
        steps += c == '-' ? std::string(" -") : std::string(1, c);
    std::istringstream numbers(steps);
    double x = 0, dx = 0, dy = 0;
    int count = 0;
    for (; numbers >> dx >> dy; ++count) x += dx;
    EXPECT_EQ(count, 1000);
    EXPECT_NEAR(x, 1000 / 256.0, 0.006);
}

TEST(Ink, TextIsOutlinesThatSayWhatTheyAre) {
    const Typesetter type;
    std::string svg;
    Ink ink(svg, type);
    ink.text("a < b", 5, 10, {.size = 8, .colour = {0, 0, 0}});
    EXPECT_TRUE(svg.starts_with("<path aria-label=\"a &lt; b\" fill=\"#000000\" d=\"M"));
    EXPECT_EQ(svg.find("<text"), std::string::npos);
    svg.clear();
    ink.text("曲げ test", 5, 10, {.size = 8, .colour = {0, 0, 0}, .strong = true});
    EXPECT_NE(svg.find("stroke-width=\"0.28\""), std::string::npos)
        << "the font without semi-bold is thickened";
}

}  // namespace
}  // namespace hibi
