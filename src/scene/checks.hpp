#pragma once
#include "scene/problems.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// Tells the problems what of a scene makes no sense, as far as it shows without building it.
void check_scene(const Scene& scene, Problems& problems);

}  // namespace hibi
