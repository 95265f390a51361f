#include "image/theme.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

namespace hibi {
namespace {

struct Published {
    int index;
    int rgb[3];
};

/// Entries of the published tables, as matplotlib 3.6 gives them, times 255 and rounded.
const std::map<std::string, std::vector<Published>> published = {{"viridis",
                                                                  {{0, {68, 1, 84}},
                                                                   {3, {69, 5, 89}},
                                                                   {52, {64, 69, 136}},
                                                                   {128, {33, 145, 140}},
                                                                   {201, {115, 208, 86}},
                                                                   {254, {251, 231, 35}},
                                                                   {255, {253, 231, 37}}}},
                                                                 {"cividis",
                                                                  {{0, {0, 34, 78}},
                                                                   {3, {0, 37, 83}},
                                                                   {52, {54, 70, 108}},
                                                                   {128, {125, 124, 120}},
                                                                   {201, {197, 181, 104}},
                                                                   {254, {254, 230, 54}},
                                                                   {255, {254, 232, 56}}}}};

TEST(ColourMap, MatchesThePublishedTablesWithinTwo) {
    for (const auto& [name, entries] : published)
        for (const Published& p : entries)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(colour_map(name)[p.index][c], p.rgb[c], 2) << name << p.index;
}

TEST(ColourMap, InfernoBeginsWhereItStandsOutFromTheDarkTheme) {
    // Published entries 51 = 0.2 * 255, 205 and 255 of inferno (matplotlib 3.6).
    const auto near = [](int index, std::array<int, 3> rgb) {
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(colour_map("inferno")[index][c], rgb[c], 2) << index;
    };
    near(0, {66, 10, 104});
    near(192, {252, 165, 10});  // (205 - 51) / (255 - 51) * 255 = 192.5
    near(255, {252, 255, 164});
    const Rgb& background = theme("dark").background;
    EXPECT_GT(colour_map("inferno")[0][2] - 255 * background[2], 50);
}

using Colour = std::array<double, 3>;

double linear(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }

/// OKLab (Ottosson 2020) of linear R, G, B.
Colour oklab(const Colour& c) {
    const auto [r, g, b] = c;
    const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
    const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
    const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
    return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
            1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
            0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

double lightness(const std::array<unsigned char, 3>& rgb) {
    return oklab({linear(rgb[0] / 255.0), linear(rgb[1] / 255.0), linear(rgb[2] / 255.0)})[0];
}

TEST(ColourMap, DivergingIsEquallyStrongBothWaysAndDarkestInTheMiddle) {
    const ColourMap& map = colour_map("diverging");
    for (int i = 0; i < 128; ++i) EXPECT_NEAR(lightness(map[i]), lightness(map[255 - i]), 0.02) << i;
    for (int i = 129; i < 255; ++i) EXPECT_GT(lightness(map[i + 1]), lightness(map[i])) << i;
    EXPECT_GT(map[30][2], map[30][0] + 50);    // low: blue
    EXPECT_GT(map[225][0], map[225][2] + 50);  // high: red to yellow
}

Colour linear(const Rgb& rgb) { return {linear(rgb[0]), linear(rgb[1]), linear(rgb[2])}; }

/// What those see who lack the cones for red or green: Machado, Oliveira and Fernandes 2009, severity 1.
Colour seen_by(const std::array<Colour, 3>& eye, const Colour& c) {
    Colour seen;
    for (int k = 0; k < 3; ++k)
        seen[k] = std::max(0.0, eye[k][0] * c[0] + eye[k][1] * c[1] + eye[k][2] * c[2]);
    return seen;
}

TEST(Series, ColoursAreToldApartAlsoByTheColourBlind) {
    const std::array<Colour, 3> everybody{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const std::array<Colour, 3> no_red{
        {{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}};
    const std::array<Colour, 3> no_green{
        {{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}};
    for (const std::string& name : theme_names())
        for (const auto& eye : {everybody, no_red, no_green}) {
            const auto& series = theme(name).series;
            for (std::size_t i = 0; i < series.size(); ++i)
                for (std::size_t j = 0; j < i; ++j) {
                    const Colour a = oklab(seen_by(eye, linear(series[i])));
                    const Colour b = oklab(seen_by(eye, linear(series[j])));
                    // Five times what is just noticed side by side (0.02).
                    EXPECT_GT(std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]), 0.1) << name << i << j;
                }
        }
}

TEST(Series, ColoursStandOutFromTheBackground) {
    const auto luminance = [](const Rgb& rgb) {
        const Colour c = linear(rgb);
        return 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2] + 0.05;
    };
    for (const std::string& name : theme_names())
        for (const Rgb& colour : theme(name).series) {
            const double a = luminance(colour), b = luminance(theme(name).background);
            EXPECT_GE(std::max(a, b) / std::min(a, b), 3) << name;  // WCAG 2.1, 1.4.11, for graphics
        }
}

TEST(Names, ListedOnesExistAndOthersAreRefused) {
    for (const std::string& name : theme_names()) EXPECT_NO_THROW(theme(name));
    for (const std::string& name : colour_map_names()) EXPECT_NO_THROW(colour_map(name));
    EXPECT_THROW(theme("Dark"), std::out_of_range);
    EXPECT_THROW(colour_map("jet"), std::out_of_range);
}

}  // namespace
}  // namespace hibi
