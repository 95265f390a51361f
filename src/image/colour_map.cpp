#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "image/theme.hpp"

namespace hibi {

namespace {

// Control points at equal distances; straight lines between them match the published tables of 256 colours
// within 2/255. viridis, inferno: van der Walt & Smith 2015 (CC0); cividis: Nunez, Anderton & Renslow 2018,
// PLoS ONE 13 (CC0), closer points because its blue has a kink.
constexpr std::string_view viridis =
    "440154 46085c 471063 481769 481d6f 482475 472a7a 46307e 453781 433d84 414287 3f4889 3d4e8a "
    "3a538b 38598c 355e8d 33638d 31688e 2e6d8e 2c718e 2a768e 297b8e 27808e 25848e 23898e 218e8d "
    "20928c 1f978b 1e9c89 1fa188 21a585 24aa83 28ae80 2eb37c 35b779 3dbc74 46c06f 50c46a 5ac864 "
    "65cb5e 70cf57 7cd250 89d548 95d840 a2da37 b0dd2f bddf26 cae11f d8e219 e5e419 f1e51d fde725 ";
constexpr std::string_view inferno =
    "000004 02020c 050417 0a0722 10092d 160b39 1e0c45 260c51 2f0a5b 380962 400a67 490b6a 510e6c "
    "59106e 61136e 69166e 71196e 781c6d 801f6c 88226a 902568 982766 a02a63 a82e5f b0315b b73557 "
    "bf3952 c63d4d cc4248 d34743 d94d3d df5337 e45a31 e9612b ed6925 f1711f f47918 f78212 f98b0b "
    "fa9407 fb9d07 fca60c fcb014 fbba1f fac42a f8cd37 f6d746 f4e156 f2ea69 f2f27d f5f992 fcffa4 ";
constexpr std::string_view cividis =
    "00224e 002553 002758 00295d 002b62 002d68 002f6d 003170 053371 0f3570 163770 1c396f 213b6e "
    "263d6e 2a3f6d 2e416d 32436d 35456c 39486c 3c4a6c 3f4c6c 424e6c 45506c 48526c 4b546c 4e566c "
    "51586d 545a6d 565c6d 595e6e 5c616e 5e636f 61656f 646770 666970 696b71 6c6d72 6e6f73 717274 "
    "737475 767676 787877 7b7a78 7e7c78 807f78 838179 868379 898578 8c8878 8f8a78 928c78 948e77 "
    "979177 9a9376 9d9576 a09875 a39a74 a69c74 a99f73 aca172 afa471 b3a670 b6a96f b9ab6d bcae6c "
    "bfb06b c2b369 c5b568 c8b866 ccba64 cfbd62 d2c060 d5c25e d9c55c dcc859 dfca57 e2cd54 e6d051 "
    "e9d34e edd54a f0d846 f3db42 f7de3e fbe138 fee434 fee838 ";

// From the middle to the low end of the diverging map. Ours: at each point the lightness (OKLab, Ottosson
// 2020) of the upper half, hue going from inferno's purple by blue to mint, so that equal magnitudes look
// equally strong.
constexpr std::string_view cold =
    "420a68 471770 47237b 432e8a 3d379a 3640aa 334bb1 3155b8 305fbe 2f69c3 2f72c9 307ccd 2b87d1 2592d4 "
    "239dd5 27a8d7 2cb2d9 35bdda 41c7db 4fd1dd 5fdbe2 77e3e4 8eece8 a3f5ed b8fdf2 e3fff8 ";

/// Where inferno begins: darker colours would drown in a dark background.
constexpr double inferno_begin = 0.2;

int digit(char c) { return c <= '9' ? c - '0' : c - 'a' + 10; }

/// The colour at t in 0..1 along the control points, channel 0..2, unrounded.
double along(std::string_view points, double t, int channel) {
    const int last = static_cast<int>(points.size()) / 7 - 1;
    const int i = std::min(static_cast<int>(t * last), last - 1);
    const auto value = [&](int point) {
        return digit(points[7 * point + 2 * channel]) * 16 + digit(points[7 * point + 2 * channel + 1]);
    };
    return value(i) + (t * last - i) * (value(i + 1) - value(i));
}

template <class Colour>
ColourMap table(Colour&& colour) {
    ColourMap map;
    for (int i = 0; i < 256; ++i)
        for (int c = 0; c < 3; ++c) map[i][c] = static_cast<unsigned char>(std::lround(colour(i / 255.0, c)));
    return map;
}

double trimmed_inferno(double t, int channel) {
    return along(inferno, inferno_begin + (1 - inferno_begin) * t, channel);
}

}  // namespace

const std::vector<std::string>& colour_map_names() {
    static const std::vector<std::string> names = {"viridis", "cividis", "inferno", "diverging"};
    return names;
}

const ColourMap& colour_map(const std::string& name) {
    static const ColourMap maps[] = {table([](double t, int c) { return along(viridis, t, c); }),
                                     table([](double t, int c) { return along(cividis, t, c); }),
                                     table(trimmed_inferno), table([](double t, int c) {
                                         return t < 0.5 ? along(cold, 1 - 2 * t, c)
                                                        : trimmed_inferno(2 * t - 1, c);
                                     })};
    static const ColourMap on_dark =
                               table([](double t, int c) { return along(viridis, 0.35 + 0.65 * t, c); }),
                           on_light = table([](double t, int c) { return along(viridis, 0.88 * t, c); });
    for (int i = 0; i < 4; ++i)
        if (colour_map_names()[i] == name) return maps[i];
    if (name == "viridis_on_dark") return on_dark;
    if (name == "viridis_on_light") return on_light;
    throw std::out_of_range("no colour map \"" + name + "\"");
}

}  // namespace hibi
