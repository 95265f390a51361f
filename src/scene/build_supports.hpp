#pragma once
#include <optional>

#include "scene/problems.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// Reports a component of a particle that two supports or loads both prescribe.
void check_conflicts(const Built<2>& built, Problems& problems);

/// A particle of a part, hanging together by bonds, that is not held against all three motions of a rigid
/// body.
std::optional<int> free_particle(const Built<2>& built);

}  // namespace hibi
