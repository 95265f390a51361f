#pragma once
#include <vector>

#include "scene/block_reader.hpp"
#include "scene/problems.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// Reports what is wrong with a scene as a whole, once it has been read. `moments` are those that were read.
void check_scene(const Scene& scene, const std::vector<GivenMoment>& moments, Problems& problems);

}  // namespace hibi
