#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "render/gl.hpp"

namespace hibi {

/// The files of shaders/ as they were when the program was built, by name: "particle.vert", ...
const std::map<std::string, std::string>& built_in_shaders();

/// A linked pair of shaders: NAME.vert and NAME.frag. It lives as long as its context.
class Program {
 public:
    /// Throws std::runtime_error naming the file: missing, or the compiler's log.
    Program(const Gl& gl, const std::string& name, const std::optional<std::filesystem::path>& folder);

    void use() const { gl_.UseProgram(id_); }
    void set(const char* uniform, int value) const { gl_.Uniform1i(at(uniform), value); }
    void set(const char* uniform, float value) const { gl_.Uniform1f(at(uniform), value); }
    void set(const char* uniform, float x, float y) const { gl_.Uniform2f(at(uniform), x, y); }
    void set(const char* uniform, float x, float y, float z) const { gl_.Uniform3f(at(uniform), x, y, z); }

 private:
    /// A uniform the shader does not use has no place, and setting it does nothing: right while a look is
    /// tuned.
    GLint at(const char* uniform) const { return gl_.GetUniformLocation(id_, uniform); }

    const Gl& gl_;
    GLuint id_ = 0;
};

}  // namespace hibi
