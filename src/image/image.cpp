#include "image/image.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "base/hash.hpp"

namespace hibi {

namespace {

/// Rounded to the nearest; neither is negative.
int divided(int number, int by) { return (number + by / 2) / by; }

/// B, G, R
std::array<int, 3> bytes_of(const Rgb& colour) {
    const auto byte = [](float value) { return static_cast<int>(255 * value + 0.5f); };
    return {byte(colour[2]), byte(colour[1]), byte(colour[0])};
}

}  // namespace

bool is_opaque(const Image& image) {
    if (!image.transparent) return true;
    for (std::size_t alpha = 3; alpha < image.bgra.size(); alpha += 4)
        if (image.bgra[alpha] != 255) return false;
    return true;
}

void to_rgb(const std::uint8_t* bgra, int pixels, std::uint8_t* rgb) {
    for (int i = 0; i < pixels; ++i) {
        rgb[3 * i] = bgra[4 * i + 2];
        rgb[3 * i + 1] = bgra[4 * i + 1];
        rgb[3 * i + 2] = bgra[4 * i];
    }
}

void find_alpha(Image& image, const Image& over_white) {
    assert(image.bgra.size() == over_white.bgra.size());
    for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
        std::uint8_t* black = image.bgra.data() + i;
        const std::uint8_t* white = over_white.bgra.data() + i;
        // The three differences agree but for rounding, and no colour is larger than its alpha.
        const int through = white[0] - black[0] + white[1] - black[1] + white[2] - black[2];
        const int alpha = 255 - std::clamp((through + 1) / 3, 0, 255);
        black[3] = static_cast<std::uint8_t>(std::max({alpha, int{black[0]}, int{black[1]}, int{black[2]}}));
    }
    image.transparent = true;
}

Image laid_on(Image image, const Rgb& colour) {
    if (!image.transparent) return image;
    const std::array<int, 3> below = bytes_of(colour);
    for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
        std::uint8_t* pixel = image.bgra.data() + i;
        for (int c = 0; c < 3; ++c)
            pixel[c] = static_cast<std::uint8_t>(
                std::min(255, pixel[c] + divided((255 - pixel[3]) * below[c], 255)));
    }
    image.transparent = false;
    return image;
}

void to_straight(const Image& image, std::uint8_t* straight, const Rgb& hidden) {
    const std::array<int, 3> below = bytes_of(hidden);
    for (std::size_t i = 0; i < image.bgra.size(); i += 4) {
        const std::uint8_t* pixel = image.bgra.data() + i;
        const int alpha = image.transparent ? pixel[3] : 255;
        for (int c = 0; c < 3; ++c)
            straight[i + c] = static_cast<std::uint8_t>(alpha == 255 ? pixel[c]
                                                        : alpha == 0 ? below[c]
                                                                     : divided(255 * pixel[c], alpha));
        straight[i + 3] = static_cast<std::uint8_t>(alpha);
    }
}

void to_premultiplied(std::uint8_t* bgra, int pixels) {
    for (int i = 0; i < 4 * pixels; i += 4)
        for (int c = 0; c < 3; ++c)
            bgra[i + c] = static_cast<std::uint8_t>(divided(bgra[i + c] * bgra[i + 3], 255));
}

std::string pixel_hash(const Image& image) {
    const std::string head = fmt::format("{}x{}\n", image.width, image.height);
    const int pixels = image.width * image.height;
    const bool opaque = is_opaque(image);
    std::vector<std::uint8_t> bytes(head.size() + std::size_t(opaque ? 3 : 4) * pixels);
    std::ranges::copy(head, bytes.begin());
    std::uint8_t* body = bytes.data() + head.size();
    if (!opaque) {
        to_straight(image, body);
        for (int i = 0; i < pixels; ++i) std::swap(body[4 * i], body[4 * i + 2]);
    } else {
        to_rgb(image.bgra.data(), pixels, body);
    }
    return sha256(bytes.data(), bytes.size());
}

}  // namespace hibi
