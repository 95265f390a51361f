#pragma once
#include <cstddef>
#include <optional>
#include <string>

#include "scene/read.hpp"

namespace hibi {

inline constexpr std::size_t largest_scene_bytes = std::size_t(16) << 20;

/// What must be known about a text before a TOML parser may see it: that it is text at all, of a sane length,
/// and that its brackets and dotted keys do not nest so deep that a recursive parser would overflow its
/// stack.
std::optional<SceneError> prescan(const std::string& source);

}  // namespace hibi
