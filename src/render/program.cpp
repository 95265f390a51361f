#include "render/program.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <stdexcept>

namespace hibi {
namespace {

struct Source {
    std::string place, text;
};

Source source_of(const std::string& file, const std::optional<std::filesystem::path>& folder) {
    if (!folder) return {"shaders/" + file, built_in_shaders().at(file)};
    const std::filesystem::path path = *folder / file;
    std::ifstream stream(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream) throw std::runtime_error(fmt::format("{}: cannot read the shader", path.string()));
    return {path.string(), std::move(text)};
}

GLuint compile(const Gl& gl, GLenum kind, const Source& source) {
    const GLuint shader = gl.CreateShader(kind);
    const char* text = source.text.c_str();
    gl.ShaderSource(shader, 1, &text, nullptr);
    gl.CompileShader(shader);
    GLint good = 0;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (!good) {
        char log[4096] = "";
        gl.GetShaderInfoLog(shader, sizeof log, nullptr, log);
        throw std::runtime_error(fmt::format("{}: cannot compile the shader:\n{}", source.place, log));
    }
    return shader;
}

}  // namespace

Program::Program(const Gl& gl, const std::string& name, const std::optional<std::filesystem::path>& folder)
    : gl_(gl), id_(gl.CreateProgram()) {
    const Source vertex = source_of(name + ".vert", folder);
    const Source fragment = source_of(name + ".frag", folder);
    gl.AttachShader(id_, compile(gl, GL_VERTEX_SHADER, vertex));
    gl.AttachShader(id_, compile(gl, GL_FRAGMENT_SHADER, fragment));
    gl.LinkProgram(id_);
    GLint good = 0;
    gl.GetProgramiv(id_, GL_LINK_STATUS, &good);
    if (!good) {
        char log[4096] = "";
        gl.GetProgramInfoLog(id_, sizeof log, nullptr, log);
        throw std::runtime_error(
            fmt::format("{}: does not link with {}:\n{}", fragment.place, vertex.place, log));
    }
}

}  // namespace hibi
