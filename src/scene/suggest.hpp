#pragma once
#include <optional>
#include <string>
#include <vector>

namespace hibi {

/// The known name that a mistyped one most likely means: at most a third of its letters differ, swapped
/// neighbours count once. Nothing where none is near.
std::optional<std::string> nearest(const std::string& name, const std::vector<std::string>& known);

/// "a, b, c"
std::string list_of(const std::vector<std::string>& names);

}  // namespace hibi
