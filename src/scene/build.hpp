#pragma once
#include "scene/problems.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// Builds what of a scene is fine, and tells the problems what shows only now: selections and bodies without
/// a particle, bodies that overlap, notches that cut nothing, supports that do not hold.
Built<2> assemble(const Scene& scene, Problems& problems);

}  // namespace hibi
