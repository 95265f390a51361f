#pragma once
#include <array>
#include <string>
#include <vector>

#include "image/view.hpp"
#include "record/run_folder.hpp"

namespace hibi {

/// The last state that counts for what is fixed over a run: the first at or after separation, else the very
/// last.
int last_counting_state(const RunReader& run);

/// What follows is worked out once per reader of a run.

/// When each particle becomes detached: from then on it belongs to a piece of less than a fiftieth of all
/// particles (s); infinite: never, or from the start.
const std::vector<double>& detached_at(const RunReader& run);

/// Box around the particles in all states that count (m), discs included, but for those that have come loose:
/// x0, y0, x1, y1, counted from the origin (m).
std::array<double, 4> body_window(const RunReader& run, const View& view,
                                  const Vec3& origin = Vec3::Zero());

/// Displacements (m) in a state of the particles that supports and loads hold, by particle.
const std::vector<std::pair<int, Vec3>>& anchor_displacements(const RunReader& run, int state);

/// Range of the coloured field over all states that count, from the finite values, ends rounded outward.
/// Holds zero; symmetric about it where the map has its middle there. Never empty.
std::array<double, 2> colour_range(const RunReader& run, const std::string& field, bool symmetric);

}  // namespace hibi
