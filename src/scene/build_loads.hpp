#pragma once
#include <string>
#include <vector>

#include "scene/problems.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// The particles of a selection; an empty one is reported under path + "/where".
std::vector<int> select(const Model<2>& model, const Selection& selection, const std::string& path,
                        const std::string& block, Problems& problems);

/// How far a point lies behind a face (left, right, bottom, top) of a box (m).
double depth_behind(const Body<2>& body, const std::string& face, const Vec<2>& X);

/// The particles, shares and direction of a [[load]]. `areas` are the model's nodal areas, where it needs
/// them.
Load make_load(const Scene& scene, const Model<2>& model, const LoadSpec& spec, const std::string& path,
               const std::vector<Vec<2>>& areas, Problems& problems);

}  // namespace hibi
