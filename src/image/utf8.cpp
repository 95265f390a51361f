#include "image/utf8.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace hibi {

std::u32string decode_utf8(const std::string& text) {
    std::u32string points;
    for (std::size_t i = 0; i < text.size();) {
        const unsigned char lead = static_cast<unsigned char>(text[i]);
        const int more = lead < 0x80   ? 0
                         : lead < 0xc2 ? -1
                         : lead < 0xe0 ? 1
                         : lead < 0xf0 ? 2
                         : lead < 0xf5 ? 3
                                       : -1;
        char32_t point = more <= 0 ? lead : lead & (0x3f >> more);
        bool good = more >= 0 && i + more < text.size();
        for (int k = 1; good && k <= more; ++k) {
            const unsigned char byte = static_cast<unsigned char>(text[i + k]);
            good = (byte & 0xc0) == 0x80;
            point = point << 6 | (byte & 0x3f);
        }
        const char32_t smallest = more == 3 ? 0x10000 : more == 2 ? 0x800 : 0;
        if (!good || point < smallest || point > 0x10ffff || (point >= 0xd800 && point < 0xe000))
            throw std::runtime_error(fmt::format("text is not UTF-8 at byte {}", i + 1));
        points += point;
        i += 1 + more;
    }
    return points;
}

std::string encode_utf8(std::u32string_view points) {
    std::string text;
    for (const char32_t p : points) {
        const auto add = [&](char32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
        if (p < 0x80) {
            add(p);
        } else if (p < 0x800) {
            add(0xc0 | p >> 6), add(0x80 | (p & 0x3f));
        } else if (p < 0x10000) {
            add(0xe0 | p >> 12), add(0x80 | (p >> 6 & 0x3f)), add(0x80 | (p & 0x3f));
        } else {
            add(0xf0 | p >> 18), add(0x80 | (p >> 12 & 0x3f)), add(0x80 | (p >> 6 & 0x3f)),
                add(0x80 | (p & 0x3f));
        }
    }
    return text;
}

}  // namespace hibi
