#pragma once
#include <string>
#include <utility>
#include <vector>

namespace hibi {

/// The scenes that come with the program, by name and text, in alphabetical order; then those of `hibi
/// verify`, whose names begin with "verify/".
const std::vector<std::pair<std::string, std::string>>& built_in_scenes();

struct NewOptions {
    std::string name;   ///< file to write; empty: my_scene.toml; .toml is added
    std::string from;   ///< a built-in scene; empty: the starter scene
    bool list = false;  ///< print the built-in scenes instead
};

/// `hibi new`: writes a commented scene to start from. Returns the exit status: 2 where the file exists
/// already or there is no such scene. Throws std::runtime_error where it cannot be written.
int new_command(const NewOptions& options);

}  // namespace hibi
