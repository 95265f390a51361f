#include "image/image.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/hash.hpp"

namespace hibi {

void to_rgb(const std::uint8_t* bgra, int pixels, std::uint8_t* rgb) {
    for (int i = 0; i < pixels; ++i) {
        rgb[3 * i] = bgra[4 * i + 2];
        rgb[3 * i + 1] = bgra[4 * i + 1];
        rgb[3 * i + 2] = bgra[4 * i];
    }
}

std::string pixel_hash(const Image& image) {
    const std::string head = fmt::format("{}x{}\n", image.width, image.height);
    std::vector<std::uint8_t> bytes(head.size() + image.bgra.size() / 4 * 3);
    std::ranges::copy(head, bytes.begin());
    to_rgb(image.bgra.data(), image.width * image.height, bytes.data() + head.size());
    return sha256(bytes.data(), bytes.size());
}

}  // namespace hibi
