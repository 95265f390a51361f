#include "image/theme.hpp"

#include <gtest/gtest.h>

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

/// Lightness in OKLab (Ottosson 2020).
double lightness(const std::array<unsigned char, 3>& rgb) {
    double linear[3];
    for (int c = 0; c < 3; ++c) {
        const double v = rgb[c] / 255.0;
        linear[c] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    }
    const auto [r, g, b] = linear;
    return 0.2104542553 * std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b) +
           0.7936177850 * std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b) -
           0.0040720468 * std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
}

TEST(ColourMap, DivergingIsEquallyStrongBothWaysAndDarkestInTheMiddle) {
    const ColourMap& map = colour_map("diverging");
    for (int i = 0; i < 128; ++i) EXPECT_NEAR(lightness(map[i]), lightness(map[255 - i]), 0.02) << i;
    for (int i = 129; i < 255; ++i) EXPECT_GT(lightness(map[i + 1]), lightness(map[i])) << i;
    EXPECT_GT(map[30][2], map[30][0] + 50);    // low: blue
    EXPECT_GT(map[225][0], map[225][2] + 50);  // high: red to yellow
}

TEST(Names, ListedOnesExistAndOthersAreRefused) {
    for (const std::string& name : theme_names()) EXPECT_NO_THROW(theme(name));
    for (const std::string& name : colour_map_names()) EXPECT_NO_THROW(colour_map(name));
    EXPECT_THROW(theme("Dark"), std::out_of_range);
    EXPECT_THROW(colour_map("jet"), std::out_of_range);
}

}  // namespace
}  // namespace hibi
