#pragma once
#define GL_GLEXT_PROTOTYPES  // declarations only, for their types: nothing here links a GL library
#include <GL/glcorearb.h>

namespace hibi {

class Context;

// Every OpenGL function the renderer calls, without its prefix.
#define HIBI_GL_FUNCTIONS(X)                                                                                 \
    X(ActiveTexture)                                                                                         \
    X(AttachShader)                                                                                          \
    X(BindBuffer)                                                                                            \
    X(BindFramebuffer)                                                                                       \
    X(BindRenderbuffer) X(BindTexture) X(BindVertexArray) X(BlendFuncSeparate) X(BufferData)                 \
        X(BufferSubData) X(CheckFramebufferStatus) X(Clear) X(ClearColor) X(CompileShader) X(CreateProgram)  \
            X(CreateShader) X(DrawArrays) X(DrawElements) X(Enable) X(Disable) X(Finish)                     \
                X(FramebufferRenderbuffer) X(GenBuffers) X(GenFramebuffers) X(GenRenderbuffers)              \
                    X(GenTextures) X(GenVertexArrays) X(GetError) X(GetProgramInfoLog) X(GetProgramiv)       \
                        X(GetShaderInfoLog) X(GetShaderiv) X(GetString) X(GetUniformLocation) X(LinkProgram) \
                            X(PixelStorei) X(ReadPixels) X(RenderbufferStorage) X(Scissor) X(ShaderSource)   \
                                X(TexBuffer) X(TexImage2D) X(TexParameteri) X(Uniform1f) X(Uniform1i)        \
                                    X(Uniform2f) X(Uniform3f) X(UseProgram) X(Viewport)

/// The OpenGL functions of one context. libOSMesa and libOpenGL export the same names, so the program links
/// neither and calls only through such a table.
struct Gl {
    /// The context must be current. Throws std::runtime_error naming a function that is missing.
    explicit Gl(const Context& context);

#define HIBI_GL_MEMBER(name) decltype(&gl##name) name = nullptr;
    HIBI_GL_FUNCTIONS(HIBI_GL_MEMBER)
#undef HIBI_GL_MEMBER
};

}  // namespace hibi
