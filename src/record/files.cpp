#include "record/files.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace hibi {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& operation) {
    throw std::runtime_error(
        fmt::format("{}: cannot {}: {}", file.string(), operation, std::strerror(errno)));
}

}  // namespace

std::filesystem::path part_of(const std::filesystem::path& file) { return file.string() + ".tmp"; }

void rename_part(const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::rename(part_of(file), file, error);
    if (error)
        throw std::runtime_error(
            fmt::format("{}: cannot give the finished file its name: {}", file.string(), error.message()));
}

void write_file(const std::filesystem::path& file, const std::string& text) {
    std::ofstream stream(part_of(file), std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) fail(file, "write the file");
    rename_part(file);
}

std::string read_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    // A folder opens like a file; only reading from it fails.
    if (stream && stream.peek() != std::ifstream::traits_type::eof()) text << stream.rdbuf();
    if (!stream.is_open() || stream.bad()) fail(file, "read the file");
    return text.str();
}

}  // namespace hibi
