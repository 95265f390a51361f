#pragma once
#include <filesystem>
#include <string>

namespace hibi {

/// Can the scene be read only once, because it comes from a pipe or a device: /dev/stdin, /dev/fd/63 of
/// `hibi run <(...)`, a FIFO? What lies in /dev or /proc counts even if it is a link to a file, because the
/// name means something else in every process.
bool is_stream(const std::filesystem::path& scene);

/// The name by which a scene without a title, and the folder of its run, are called: "beam" of beam.toml,
/// "stdin" of /dev/stdin, "pipe" of a pipe that has only a number.
std::string scene_name(const std::filesystem::path& scene);

/// The text of a scene. Throws SceneErrors where it cannot be read, or is too long to be a scene.
std::string read_scene_text(const std::filesystem::path& scene);

/// Throws SceneErrors where the scene is a stream, for commands that read it more than once.
void require_file(const std::filesystem::path& scene);

}  // namespace hibi
