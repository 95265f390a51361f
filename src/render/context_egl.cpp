#define EGL_EGLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <stdexcept>

#include "render/context.hpp"

namespace hibi {
namespace {

/// EGL on Mesa's surfaceless platform: no display server, no X11.
class EglContext : public Context {
 public:
    EglContext() {
        const auto display_of = library_.get<decltype(&eglGetPlatformDisplay)>("eglGetPlatformDisplay");
        const auto initialize = library_.get<decltype(&eglInitialize)>("eglInitialize");
        const auto bind_api = library_.get<decltype(&eglBindAPI)>("eglBindAPI");
        const auto choose = library_.get<decltype(&eglChooseConfig)>("eglChooseConfig");
        const auto create = library_.get<decltype(&eglCreateContext)>("eglCreateContext");

        display_ = display_of(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
        if (display_ == EGL_NO_DISPLAY || !initialize(display_, nullptr, nullptr))
            fail("open the surfaceless platform");
        if (!bind_api(EGL_OPENGL_API)) fail("use desktop OpenGL");
        const EGLint wanted[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_PBUFFER_BIT,
                                 EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (!choose(display_, wanted, &config, 1, &count) || count == 0) fail("find a configuration");
        const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                     3,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     3,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
        context_ = create(display_, config, EGL_NO_CONTEXT, attributes);
        if (context_ == EGL_NO_CONTEXT) fail("create an OpenGL 3.3 core context");
    }
    // The display stays open: all contexts of the process share it, and closing it would end theirs.
    ~EglContext() override { destroy_(display_, context_); }

    void make_current() override {
        if (!current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_))
            fail("make the OpenGL context current");
    }
    void release() override { current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }
    EntryPoint entry_point(const char* name) const override { return address_(name); }
    std::string library() const override { return "EGL"; }

 private:
    [[noreturn]] void fail(const char* what) const {
        throw std::runtime_error(fmt::format(
            "EGL: cannot {} (error {:#06x}); install the package libgl1-mesa-dri", what, error_()));
    }

    Library library_{"libEGL.so.1", "libegl1"};
    decltype(&eglGetError) error_ = library_.get<decltype(&eglGetError)>("eglGetError");
    decltype(&eglDestroyContext) destroy_ = library_.get<decltype(&eglDestroyContext)>("eglDestroyContext");
    decltype(&eglMakeCurrent) current_ = library_.get<decltype(&eglMakeCurrent)>("eglMakeCurrent");
    decltype(&eglGetProcAddress) address_ = library_.get<decltype(&eglGetProcAddress)>("eglGetProcAddress");
    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> make_egl_context() { return std::make_unique<EglContext>(); }

}  // namespace hibi
