#pragma once
#include <filesystem>
#include <string>

namespace hibi {

/// The name a file has while it is being written; only a finished file gets its own name.
std::filesystem::path part_of(const std::filesystem::path& file);

/// Gives a finished part its name. Throws std::runtime_error naming the file.
void rename_part(const std::filesystem::path& file);

/// Writes a whole text file: first its part, then the rename. Throws std::runtime_error naming the file.
void write_file(const std::filesystem::path& file, const std::string& text);

/// The whole file. Throws std::runtime_error naming it.
std::string read_file(const std::filesystem::path& file);

}  // namespace hibi
