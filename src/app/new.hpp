#pragma once
#include <string>

namespace hibi {

struct NewOptions {
    std::string name;   ///< file to write; empty: my_scene.toml; .toml is added
    std::string from;   ///< a built-in scene; empty: the starter scene
    bool list = false;  ///< print the built-in scenes instead
};

/// `hibi new`: writes a commented scene to start from. Returns the exit status: 2 where the file exists
/// already or there is no such scene. Throws std::runtime_error where it cannot be written.
int new_command(const NewOptions& options);

}  // namespace hibi
