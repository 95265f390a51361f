#pragma once
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>

#include "image/image.hpp"

namespace hibi {

/// A mistake in what is to be compared.
[[noreturn]] void refuse_to_compare(const std::string& what);

/// What reading a file complains of is the user's matter here: the file is the input. Throws
/// std::invalid_argument with a way out for what `read` throws.
template <class Read>
auto read_as_input(const char* way_out, Read&& read) {
    try {
        return read();
    } catch (const std::runtime_error& error) {
        refuse_to_compare(std::string(error.what()) + "; " + way_out);
    }
}

enum class ComparedKind { picture, frames, run };
const char* to_string(ComparedKind kind);
/// What a path named by the user holds. Throws std::invalid_argument where it is nothing that can be
/// compared.
ComparedKind kind_of(const std::filesystem::path& path);

/// Names of frames -> their files.
using Frames = std::map<std::string, std::filesystem::path>;
/// Of a folder of pictures, or of a film's frames.json. Throws std::invalid_argument where there are none, or
/// one is missing.
Frames frames_of(const std::filesystem::path& path);

/// A picture that is to be compared, 8 bits per channel. Throws std::invalid_argument naming the file, what
/// is wrong with it and a way out.
Image picture_to_compare(const std::filesystem::path& file);

}  // namespace hibi
