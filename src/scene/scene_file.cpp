#include "scene/scene_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "scene/prescan.hpp"
#include "scene/read.hpp"

namespace hibi {

namespace fs = std::filesystem;

bool is_stream(const fs::path& scene) {
    const std::string name = scene.lexically_normal().string();
    if (name.starts_with("/dev/") || name.starts_with("/proc/")) return true;
    std::error_code none;
    return fs::exists(scene, none) && fs::is_other(scene, none);
}

std::string scene_name(const fs::path& scene) {
    const std::string name = scene.stem().string();
    return is_stream(scene) && name.find_first_not_of("0123456789") == std::string::npos ? "pipe" : name;
}

std::string read_scene_text(const fs::path& scene) {
    const auto refuse = [&](const std::string& message, const std::string& hint) {
        throw SceneErrors(scene.string(), "", {SceneError{0, 0, 1, message, hint}});
    };
    if (fs::is_directory(scene)) refuse("this is a folder", "name the scene file in it");
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> in(std::fopen(scene.c_str(), "rb"), &std::fclose);
    if (!in)
        refuse(fmt::format("cannot open it: {}", std::strerror(errno)),
               "`hibi new` writes a scene to start from");
    // One byte more than is allowed is enough to refuse it; devices never end.
    std::string text(largest_scene_bytes + 1, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), in.get()));
    if (std::ferror(in.get())) refuse(fmt::format("cannot read it: {}", std::strerror(errno)), "");
    return text;
}

void require_file(const fs::path& scene) {
    if (!is_stream(scene)) return;
    throw SceneErrors(
        scene.string(), "",
        {{.message = "this is a pipe or a device, which can be read only once, and this command "
                     "reads the scene once for every run",
          .hint = "store the scene in a file and name that; `hibi run`, `hibi check` and `hibi "
                  "preview` take a pipe"}});
}

}  // namespace hibi
