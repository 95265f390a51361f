#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace hibi {

/// Pixels as OpenGL reads them back and Cairo draws on them: 4 bytes B, G, R, unused; rows without padding, top
/// row first.
struct Image {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bgra;

    Image() = default;
    Image(int w, int h) : width(w), height(h), bgra(std::size_t(4) * w * h) {}
    int stride() const { return 4 * width; }
    std::uint8_t* pixel(int x, int y) { return bgra.data() + 4 * (std::size_t(y) * width + x); }
    const std::uint8_t* pixel(int x, int y) const { return bgra.data() + 4 * (std::size_t(y) * width + x); }
};

/// SHA-256 of the size and the decoded RGB pixels: what frames.json holds and comparisons use.
std::string pixel_hash(const Image& image);

}  // namespace hibi
