#pragma once
#include <filesystem>

#include "pictures/draw.hpp"
#include "record/run_folder.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// Everything that is drawn of a recorded run: frames, films and poster, then figures and report unless the
/// options leave them out. Notes in the summary how many frames there are and how long it took.
void make_pictures(const Scene& scene, const std::filesystem::path& folder, DrawOptions options, bool quiet,
                   RunSummary& summary);

/// What a user looks at first of what make_pictures has written.
std::filesystem::path main_picture(const std::filesystem::path& folder, const DrawOptions& options);

}  // namespace hibi
