#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "image/image.hpp"

namespace hibi {

/// RGB, 8 bits, no alpha. Fast setting (zlib level 1, SUB filter, run lengths); `small` for single figures.
std::vector<unsigned char> encode_png(const Image& image, const std::map<std::string, std::string>& text = {}, bool small = false);
/// The same to a file, under a temporary name first. Errors: std::runtime_error naming the file.
void write_png(const std::filesystem::path& file, const Image& image, const std::map<std::string, std::string>& text = {}, bool small = false);
/// Reads any 8-bit RGB(A) PNG; throws std::runtime_error naming the file and what is wrong with it.
Image read_png(const std::filesystem::path& file);

}  // namespace hibi
