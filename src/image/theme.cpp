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
    .series = {rgb(0x74bcff), rgb(0xff9f45), rgb(0x62d493), rgb(0xff5c93), rgb(0xc3a6ff), rgb(0xe6d35a)},
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
    .series = {rgb(0x1259b0), rgb(0xc25700), rgb(0x16774a), rgb(0xd1124f), rgb(0x6a3fc0), rgb(0x7d6600)},
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
    .series = {rgb(0x0b4a99), rgb(0xb04f00), rgb(0x1b6b3d), rgb(0xb8003c), rgb(0x55309c), rgb(0x665300)},
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
