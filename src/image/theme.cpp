#include "image/theme.hpp"

#include <stdexcept>

namespace hibi {

namespace {

constexpr Rgb rgb(unsigned hex) {
    return {static_cast<float>(hex >> 16 & 255) / 255, static_cast<float>(hex >> 8 & 255) / 255,
            static_cast<float>(hex & 255) / 255};
}

constexpr Theme dark{
    .background = rgb(0x101217),
    .text = rgb(0xeef1f6),
    .faint_text = rgb(0x98a1b0),
    .line = rgb(0x7c8696),
    .grid = rgb(0x2b303a),
    .support = rgb(0xaab3c2),
    .load = rgb(0x74bcff),
    .body = rgb(0x2a303a),
    .bond = rgb(0x6d7686),
    .crack_fresh = rgb(0xff3d7f),
    .crack_old = rgb(0xf4f6fb),
    .curve = rgb(0x74bcff),
    .curve_second = rgb(0xff5c93),
    .series = {rgb(0x74bcff), rgb(0xffa630), rgb(0x73f9b8), rgb(0xf85093), rgb(0x815cee), rgb(0x7f800c)},
    .rim = 0.35f};

constexpr Theme light{
    .background = rgb(0xfbfbfc),
    .text = rgb(0x14181f),
    .faint_text = rgb(0x5d6673),
    .line = rgb(0x7f8894),
    .grid = rgb(0xdfe3e8),
    .support = rgb(0x3c4450),
    .load = rgb(0x1259b0),
    .body = rgb(0xd9dee5),
    .bond = rgb(0xa3abb7),
    .crack_fresh = rgb(0xff2b6e),
    .crack_old = rgb(0xffffff),
    .curve = rgb(0x1259b0),
    .curve_second = rgb(0xd1124f),
    .series = {rgb(0x1259b0), rgb(0xf2590a), rgb(0x359792), rgb(0x71115b), rgb(0xbd68f2), rgb(0x5e5303)},
    .rim = 0.30f};

constexpr Theme print{
    .background = rgb(0xffffff),
    .text = rgb(0x000000),
    .faint_text = rgb(0x3a3a3a),
    .line = rgb(0x000000),
    .grid = rgb(0xd0d0d0),
    .support = rgb(0x000000),
    .load = rgb(0x0b4a99),
    .body = rgb(0xdcdcdc),
    .bond = rgb(0x9a9a9a),
    .crack_fresh = rgb(0xe00040),
    .crack_old = rgb(0xffffff),
    .curve = rgb(0x0b4a99),
    .curve_second = rgb(0xb8003c),
    .series = {rgb(0x0b4a99), rgb(0xee5a0a), rgb(0x359792), rgb(0x6a0f55), rgb(0xb968ef), rgb(0x5e5303)},
    .rim = 0.0f};

}  // namespace

const std::vector<std::string>& theme_names() {
    static const std::vector<std::string> names = {"dark", "light", "print"};
    return names;
}

const Theme& theme(const std::string& name) {
    if (name == "dark") return dark;
    if (name == "light") return light;
    if (name == "print") return print;
    throw std::out_of_range("no theme \"" + name + "\"");
}

}  // namespace hibi
