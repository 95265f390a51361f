#pragma once
#include <filesystem>

namespace hibi {

/// Removes what a run writes into its folder, by name, finished or not, and nothing else.
/// Throws std::runtime_error naming what cannot be removed.
void remove_leftovers(const std::filesystem::path& folder);

/// The same for what drawing it wrote: frames, films and poster. Films stay where they are not asked for
/// anew.
void remove_pictures(const std::filesystem::path& folder, bool films = true);

/// Does the folder hold a run, finished or not?
bool holds_run(const std::filesystem::path& folder);

}  // namespace hibi
