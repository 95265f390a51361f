#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "picture_tests/diff.hpp"
#include "render/renderer.hpp"

namespace hibi {

/// Which references `hibi test` writes.
enum class Update {
    none,
    missing,  ///< those that are not there
    changed,  ///< those, and those of scenes that do not pass
    all
};

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

/// `hibi test`: runs scenes, draws the moments of their [test] blocks and compares them with the references
/// beside the scenes, exactly where the renderer and the processor are those of the references, else within
/// the tolerances. Prints a line per scene. Returns 0 where all pass, 3 where one differs or has no
/// reference, 1 where a run failed. Throws std::invalid_argument (and changes nothing) for a scene or
/// references that cannot be read, and for an update where CI=true is in the environment.
int test_command(const TestOptions& options);

}  // namespace hibi
