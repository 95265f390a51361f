#pragma once
#include "scene/block_reader.hpp"
#include "scene/document.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// Fills a scene from the blocks of a document. What is wrong is told to context.problems, and keeps its
/// default.
void read_blocks(const Value& document, ReadContext& context, Scene& scene);

}  // namespace hibi
