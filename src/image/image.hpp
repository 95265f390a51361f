#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "image/theme.hpp"

namespace hibi {

/// Pixels as OpenGL reads them back and Cairo draws on them: 4 bytes B, G, R, unused; rows without padding,
/// top row first.
struct Image {
    int width = 0, height = 0;
    bool transparent =
        false;  ///< the fourth byte is alpha, by which the colours are multiplied (as in Cairo)
    std::vector<std::uint8_t> bgra;

    Image() = default;
    Image(int w, int h) : width(w), height(h), bgra(std::size_t(4) * w * h) {}
    int stride() const { return 4 * width; }
    std::uint8_t* pixel(int x, int y) { return bgra.data() + 4 * (std::size_t(y) * width + x); }
    const std::uint8_t* pixel(int x, int y) const { return bgra.data() + 4 * (std::size_t(y) * width + x); }
};

/// Does every pixel hide what is below? Also where the image has alpha, and all of it is 255.
bool is_opaque(const Image& image);

/// The colours alone: 3 bytes R, G, B per pixel, top row first, written at `rgb`.
void to_rgb(const std::uint8_t* bgra, int pixels, std::uint8_t* rgb);

/// What a picture is whose like stands over black and over white: alpha = 1 - (white - black), and colours
/// multiplied by it, which is how it looks over black. `image` holds that one, and becomes transparent.
void find_alpha(Image& image, const Image& over_white);
/// On a colour, opaque. Opaque images stay as they are.
Image laid_on(Image image, const Rgb& colour);
/// B, G, R, alpha of every pixel, colours not multiplied by alpha, as files hold them; `hidden` where alpha
/// is 0, and alpha 255 throughout an opaque image. They come back by to_premultiplied exactly.
void to_straight(const Image& image, std::uint8_t* straight, const Rgb& hidden = {});
void to_premultiplied(std::uint8_t* bgra, int pixels);

/// SHA-256, in hexadecimal digits, of the text "WIDTHxHEIGHT\n" (decimal, ASCII) followed by R, G, B of every
/// pixel, row by row from the top left; where the image is not opaque R, G, B, A, colours not multiplied by
/// alpha. An alpha that is 255 everywhere does not count. This is what frames.json holds and comparisons use:
/// PNG bytes also carry versions and depend on the compressor.
std::string pixel_hash(const Image& image);

}  // namespace hibi
