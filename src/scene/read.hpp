#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace hibi {

struct SceneError {
    int line = 0, column = 0, length = 1;  ///< 1-based; line 0: the whole file
    std::string message;                   ///< what was found and what was expected
    std::string hint{};                    ///< a way out, shown behind the caret
};

/// Every mistake of a scene at once, sorted by place. what() is the finished text: for each
/// file:line:column: error: message, the line, a caret with the hint.
class SceneErrors : public std::runtime_error {
 public:
    SceneErrors(const std::string& file, const std::string& source, std::vector<SceneError> errors);
    const std::vector<SceneError>& errors() const { return errors_; }

 private:
    std::vector<SceneError> errors_;
};

using Overrides = std::vector<std::pair<std::string, std::string>>;  ///< -p name=value

struct BuiltScene {
    Scene scene;
    Built<2> built;
};
/// Reads, checks and builds a scene. Throws SceneErrors.
BuiltScene read_and_build(const std::filesystem::path& file, const Overrides& overrides = {});
/// Of a scene that can be built the description alone. Throws SceneErrors.
Scene read_scene(const std::filesystem::path& file, const Overrides& overrides = {});
/// The scene in the folder of a run. That it can be built has been seen, and is not looked at again: that
/// takes as long as building it.
Scene read_recorded_scene(const std::filesystem::path& folder);
/// The same as read_and_build and read_scene from text; `name` stands in the messages.
BuiltScene parse_and_build(const std::string& text, const std::string& name, const Overrides& overrides = {});
Scene parse_scene(const std::string& text, const std::string& name, const Overrides& overrides = {});

/// The completed scene as TOML: every default filled in, SI units. Reading it gives the same scene, and
/// writing that again the same text.
std::string write_scene(const Scene& scene);

/// SHA-256 of write_scene: the same for the same experiment, however it was written down.
std::string scene_hash(const Scene& scene);

/// Particles, bonds, supports and loads of a checked scene. Throws SceneErrors (without a place) for what
/// only shows now, for instance a selection without a particle.
Built<2> build(const Scene& scene);

/// The constant part of what is recorded.
Topology topology_of(const Scene& scene, const Built<2>& built);

}  // namespace hibi
