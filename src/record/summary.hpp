#pragma once
#include <filesystem>

#include "record/run_folder.hpp"

namespace hibi {

/// Reads DIR/run.json. Throws std::runtime_error naming the file, and the key or the place that is wrong.
RunSummary read_summary(const std::filesystem::path& folder);

}  // namespace hibi
