#pragma once
#include <string>
#include <utility>
#include <vector>

namespace hibi {

/// The scenes that come with the program, by name and text, in alphabetical order; then those of `hibi
/// verify`, whose names begin with "verify/".
const std::vector<std::pair<std::string, std::string>>& built_in_scenes();

}  // namespace hibi
