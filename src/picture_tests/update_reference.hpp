#pragma once
#include "picture_tests/test_results.hpp"

namespace hibi {

/// Which references `hibi test` writes.
enum class Update {
    none,
    missing,  ///< those that are not there
    changed,  ///< those, and those of scenes that do not pass
    all
};

/// Writes the references of a scene that are asked for, and notes them in its result. Old pictures stay as
/// *.old.png.
void update_reference(SceneResult& result, const DrawnTest& drawn, Update what);

}  // namespace hibi
