#include "render/gl.hpp"

#include <stdexcept>

#include "render/context.hpp"

namespace hibi {

Gl::Gl(const Context& context) {
#define HIBI_GL_LOAD(name)                                                    \
    name = reinterpret_cast<decltype(name)>(context.entry_point("gl" #name)); \
    if (!name) throw std::runtime_error(context.library() + ": has no function gl" #name);
    HIBI_GL_FUNCTIONS(HIBI_GL_LOAD)
#undef HIBI_GL_LOAD
}

}  // namespace hibi
