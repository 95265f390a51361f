#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "image/image.hpp"

namespace hibi {

/// Keyword -> UTF-8 text, stored beside the pixels. Plain ASCII goes into tEXt chunks, anything else into
/// iTXt.
using PngText = std::map<std::string, std::string>;

struct PngOptions {
    PngText text{};
    bool small =
        false;       ///< for single figures, at the cost of time; else zlib level 1, SUB filter, run lengths
    double dpi = 0;  ///< pixels per inch in print; 0: not said
};

/// RGB, 8 bits; of a transparent image RGBA, colours not multiplied by alpha and 0 where it is 0.
std::vector<unsigned char> encode_png(const Image& image, const PngOptions& options = {});
/// The same to a file, under a temporary name first. Errors: std::runtime_error naming the file.
void write_png(const std::filesystem::path& file, const Image& image, const PngOptions& options = {});
/// Reads any PNG (transparent if it has alpha; fewer channels are filled up, 16 bits are cut to 8), and its
/// texts if wanted. Throws std::runtime_error naming the file and what is wrong with it.
Image read_png(const std::filesystem::path& file, PngText* text = nullptr);

/// Is the file an animated PNG? read_png reads the first picture of one. Throws std::runtime_error naming a
/// file that is no PNG.
bool is_animated_png(const std::filesystem::path& file);

/// Bits per channel as the file's header says, 1 to 16. Throws std::runtime_error naming a file that is no
/// PNG.
int png_bit_depth(const std::filesystem::path& file);

}  // namespace hibi
