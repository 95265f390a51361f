#pragma once
#include <string>
#include <utility>
#include <vector>

namespace hibi {

/// The scenes that come with the program, by name and text, in alphabetical order.
const std::vector<std::pair<std::string, std::string>>& built_in_scenes();

/// `hibi new`: writes a commented starter scene, or with `from` a copy of a built-in one, to NAME
/// ("my_scene.toml" where it is empty; .toml is added). `list` prints the built-in scenes instead. Returns
/// the exit status: 2 where the file exists already or there is no such scene. Throws std::runtime_error
/// where it cannot be written.
int new_command(const std::string& name, const std::string& from, bool list);

}  // namespace hibi
