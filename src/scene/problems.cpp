#include "scene/problems.hpp"

#include <algorithm>

namespace hibi {

void Problems::add(const std::string& path, const std::string& message, const std::string& hint) {
    // A value that is absent is missed in the block that lacks it.
    std::string place_path = path;
    while (!places_.count(place_path) && !place_path.empty()) {
        const std::size_t slash = place_path.rfind('/');
        place_path.resize(slash == std::string::npos ? 0 : slash);
    }
    const auto found = places_.find(place_path);
    add(path, found == places_.end() ? Place{} : found->second, message, hint);
}

void Problems::add(const std::string& path, const Place& place, const std::string& message,
                   const std::string& hint) {
    if (std::find(paths_.begin(), paths_.end(), path) != paths_.end()) return;
    paths_.push_back(path);
    errors_.push_back({place.line, place.column, place.length, message, hint});
}

bool Problems::concerns(const std::string& path) const {
    return std::any_of(paths_.begin(), paths_.end(), [&](const std::string& bad) {
        return bad == path || bad.starts_with(path + "/") || path.starts_with(bad + "/");
    });
}

}  // namespace hibi
