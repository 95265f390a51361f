#pragma once
#include <array>
#include <optional>

#include "record/run_folder.hpp"

namespace hibi {

/// The point (m) that positions are counted from in a picture, so that single precision is enough for them
/// wherever the body is: the origin of the scene where that is near the window; else the lower left corner of
/// the unloaded body where that is near; else the lower left corner of the window. A body that is moved as a
/// whole therefore keeps its picture. `window` is x0, y0, x1, y1 (m); absent: the body at rest.
Vec3 drawing_origin(const Topology& topology, const std::optional<std::array<double, 4>>& window);

/// The window with its corners counted from the origin.
std::array<double, 4> counted_from(const Vec3& origin, const std::array<double, 4>& window);

/// The topology with its positions counted from the origin.
Topology counted_from(const Vec3& origin, Topology topology);

/// The same for that of a run. It is made once per reader, and is the run's own where the origin is zero.
const Topology& topology_from(const Vec3& origin, const RunReader& run);

}  // namespace hibi
