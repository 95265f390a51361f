#pragma once
#include <vector>

#include "scene/scene_block.hpp"

namespace hibi {

// One function per block of the scene, each in a file of its name.
SceneBlock top_block();  ///< the keys above the first block
SceneBlock model_block();
SceneBlock material_block();
SceneBlock body_block();
SceneBlock notch_block();
SceneBlock fix_block();
SceneBlock load_block();
SceneBlock gravity_block();
SceneBlock damping_block();
SceneBlock run_block();
SceneBlock view_block();
SceneBlock movie_block();
SceneBlock strip_block();
SceneBlock test_block();

/// All of them, in the order in which they are read and written: one may name what stands before it.
const std::vector<SceneBlock>& bound_blocks();

/// The keys of which exactly one gives a shape: box, disc, ring, polygon and, unless it stands in one itself,
/// difference.
Block<Shape<2>> shape_keys(bool may_be_difference);

}  // namespace hibi
