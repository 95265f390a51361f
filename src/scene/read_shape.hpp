#pragma once
#include <optional>
#include <string>

#include "model/shape.hpp"
#include "scene/block_reader.hpp"

namespace hibi {

/// The shape under `key` (box, disc, ring, polygon, difference) of a [[body]] or of a part of a difference.
/// Nothing where it is wrong.
std::optional<Shape<2>> read_shape(BlockReader& block, const std::string& key);

}  // namespace hibi
