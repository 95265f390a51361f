#include "render/context.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>

namespace hibi {

Library::Library(const char* file, const char* package) : file_(file) {
    handle_ = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (!handle_)
        throw std::runtime_error(fmt::format("cannot open the OpenGL library {}: {}; install the package {}",
                                             file, dlerror(), package));
}

void* Library::symbol(const char* name) const {
    void* found = dlsym(handle_, name);
    if (!found) throw std::runtime_error(fmt::format("{}: has no function {}", file_, name));
    return found;
}

std::unique_ptr<Context> make_context(GlBackend backend) {
    // The same software renderer, with the same arithmetic, on every machine. 512-bit vectors crash
    // Mesa 22.3's llvmpipe, so the width is not left to whatever a newer processor or library would choose;
    // 256 and 128 give the same bits. What the user has set stays.
    setenv("LP_NATIVE_VECTOR_WIDTH", "256", 0);
    setenv("LIBGL_ALWAYS_SOFTWARE", "1", 0);
    setenv("GALLIUM_DRIVER", "llvmpipe", 0);
    return backend == GlBackend::egl ? make_egl_context() : make_osmesa_context();
}

}  // namespace hibi
