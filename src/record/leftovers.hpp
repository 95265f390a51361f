#pragma once
#include <filesystem>

namespace hibi {

/// Removes what a run writes into its folder, by name, finished or not, and nothing else.
/// Throws std::runtime_error naming what cannot be removed.
void remove_leftovers(const std::filesystem::path& folder);

}  // namespace hibi
