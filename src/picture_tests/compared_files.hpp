#pragma once
#include <filesystem>

#include "picture_tests/picture_files.hpp"

namespace hibi {

enum class ComparedKind { picture, frames, run };
const char* to_string(ComparedKind kind);
/// What a path named by the user holds. Throws std::invalid_argument where it is nothing that can be
/// compared.
ComparedKind kind_of(const std::filesystem::path& path);

/// The frames that the frames.json of a folder lists. Throws std::invalid_argument where one is missing.
NamedFiles listed_frames(const std::filesystem::path& folder);

/// The frames that a frames.json lists, or everything that a folder holds, without what lies in `output`.
/// Throws std::invalid_argument where there is no picture.
FolderFiles files_to_compare(const std::filesystem::path& path, const std::filesystem::path& output);

}  // namespace hibi
