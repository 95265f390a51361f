#pragma once
#include <filesystem>
#include <map>
#include <string>

namespace hibi {

/// What a film says about itself: title, comment, ... Empty for a file that is no film.
std::map<std::string, std::string> film_metadata(const std::filesystem::path& file);

}  // namespace hibi
