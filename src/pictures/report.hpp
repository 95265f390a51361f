#pragma once
#include <filesystem>

#include "record/run_folder.hpp"
#include "render/renderer.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// report.html, caption.md and snippets/ of a recorded and drawn run; a film is part of the page if there is
/// one.
void write_report(const Scene& scene, const RunReader& run, const RendererOptions& renderer);

}  // namespace hibi
