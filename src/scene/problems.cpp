#include "scene/problems.hpp"

namespace hibi {

namespace {

/// "load/0/force" -> "load/0" -> "load" -> "".
void go_up(std::string& path) {
    const std::size_t slash = path.rfind('/');
    path.resize(slash == std::string::npos ? 0 : slash);
}

}  // namespace

void Problems::add(const std::string& path, const std::string& message, const std::string& hint) {
    // A value that is absent is missed in the block that lacks it.
    std::string place = path;
    while (!places_.count(place) && !place.empty()) go_up(place);
    const auto found = places_.find(place);
    add(path, found == places_.end() ? Place{} : found->second, message, hint);
}

void Problems::add(const std::string& path, const Place& place, const std::string& message,
                   const std::string& hint) {
    if (paths_.insert(path).second)
        errors_.push_back({place.line, place.column, place.length, message, hint});
}

bool Problems::concerns(const std::string& path) const {
    const auto inside = paths_.lower_bound(path + "/");
    if (inside != paths_.end() && inside->starts_with(path + "/")) return true;
    for (std::string above = path; !above.empty(); go_up(above))
        if (paths_.count(above)) return true;
    return false;
}

}  // namespace hibi
