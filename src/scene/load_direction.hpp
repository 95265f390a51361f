#pragma once
#include <optional>

#include "model/model.hpp"
#include "physics/physics.hpp"

namespace hibi {

/// Along what a load is reported: its total at full ramp, where that is about the largest until `end` (s);
/// else its total when it is first about the largest, so that a load that is zero when its ramp ends, or
/// comes later, is reported along itself. Nothing where the total vanishes: of a pressure all round, say,
/// only rounding is left.
std::optional<Vec3> load_direction(const Model<2>& model, const Load& load, double end);

}  // namespace hibi
