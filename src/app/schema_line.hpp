#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace hibi {

/// The schema file that belongs to a program: beside it in a build tree, in ../share/hibi where it is
/// installed; nothing where there is none.
std::optional<std::filesystem::path> schema_file(const std::filesystem::path& program);

/// A scene whose first line, `#:schema ADDRESS`, tells editors to use this schema; any other such line at its
/// top goes. Nothing as schema: no such line.
std::string with_schema_line(std::string scene, const std::optional<std::filesystem::path>& schema);

}  // namespace hibi
