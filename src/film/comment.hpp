#pragma once
#include <filesystem>
#include <string>

namespace hibi {

/// Puts a comment into a finished GIF, APNG or WebP, for which FFmpeg's writers have no place: a comment
/// extension, an iTXt chunk, an XMP packet. Throws std::runtime_error naming the file.
void write_film_comment(const std::filesystem::path& file, const std::string& comment);

}  // namespace hibi
