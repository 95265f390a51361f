#pragma once
#include <filesystem>
#include <optional>
#include <vector>

#include "picture_tests/test_results.hpp"
#include "picture_tests/update_reference.hpp"
#include "render/renderer.hpp"

namespace hibi {

struct TestOptions {
    std::vector<std::filesystem::path> scenes;  ///< scene files, or folders of them
    std::filesystem::path output = "out/test";  ///< runs and pictures of what failed
    std::optional<std::filesystem::path> junit{};
    Update update = Update::none;
    int jobs = 0;  ///< scenes at once; 0: one per core
    bool json = false;
    bool quiet = false;
    TestLimits limits{};  ///< these go before those of a scene
    RendererOptions renderer{};
};

/// Runs scenes, draws the moments of their [test] blocks and compares them with the references beside the
/// scenes, exactly where the renderer and the processor are those of the references, else within the
/// tolerances. Writes JUnit XML where that is asked for. Throws std::invalid_argument (and changes nothing)
/// for a scene or references that cannot be read, and for an update where CI=true is in the environment.
std::vector<SceneResult> test_scenes(const TestOptions& options);

}  // namespace hibi
