#pragma once
#include <map>
#include <set>
#include <string>
#include <vector>

#include "scene/document.hpp"
#include "scene/read.hpp"

namespace hibi {

/// Mistakes of a scene, each with the path of the value it concerns ("load/0/force/1"). Where a value stands
/// is told once, when it is read; checks that come later name the path alone.
class Problems {
 public:
    void stands_at(const std::string& path, const Place& place) { places_[path] = place; }

    /// A second mistake of the same value is left out: it mostly follows from the first.
    void add(const std::string& path, const std::string& message, const std::string& hint = {});
    void add(const std::string& path, const Place& place, const std::string& message,
             const std::string& hint);
    /// The value is wrong because of a mistake that is told elsewhere.
    void silence(const std::string& path) { paths_.insert(path); }

    /// Whether the value, something in it, or something it is in, is known to be wrong.
    bool concerns(const std::string& path) const;
    /// Whether the value may be judged further.
    bool fine(const std::string& path) const { return !concerns(path); }
    /// So many mistakes that nobody reads on: what is costly to find out may be left out.
    bool many() const { return errors_.size() > 100; }

    const std::vector<SceneError>& errors() const { return errors_; }

 private:
    std::map<std::string, Place> places_;
    std::set<std::string> paths_;
    std::vector<SceneError> errors_;
};

}  // namespace hibi
