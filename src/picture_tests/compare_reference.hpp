#pragma once
#include <filesystem>

#include "picture_tests/test_results.hpp"

namespace hibi {

/// Compares what was drawn of a scene's run with its references, exactly where the renderer and the processor
/// are those of the references, else within the tolerances; a page and pictures of what fails go below
/// `output`.
void compare_with_reference(SceneResult& result, const DrawnTest& drawn, const std::filesystem::path& output);

}  // namespace hibi
