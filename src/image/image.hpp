#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace hibi {

/// Pixels as OpenGL reads them back and Cairo draws on them: 4 bytes B, G, R, unused; rows without padding,
/// top row first.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bgra;

    Image() = default;
    Image(int w, int h) : width(w), height(h), bgra(std::size_t(4) * w * h) {}
    int stride() const { return 4 * width; }
    std::uint8_t* pixel(int x, int y) { return bgra.data() + 4 * (std::size_t(y) * width + x); }
    const std::uint8_t* pixel(int x, int y) const { return bgra.data() + 4 * (std::size_t(y) * width + x); }
};

/// The colours alone: 3 bytes R, G, B per pixel, top row first, written at `rgb`.
void to_rgb(const std::uint8_t* bgra, int pixels, std::uint8_t* rgb);

/// SHA-256, in hexadecimal digits, of the text "WIDTHxHEIGHT\n" (decimal, ASCII) followed by R, G, B of every
/// pixel, row by row from the top left. The fourth byte of a pixel does not count. This is what frames.json
/// holds and comparisons use: PNG bytes also carry versions and depend on the compressor.
std::string pixel_hash(const Image& image);

}  // namespace hibi
