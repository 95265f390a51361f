#include <GL/osmesa.h>

#include <array>
#include <stdexcept>

#include "render/context.hpp"

namespace hibi {
namespace {

class OsmesaContext : public Context {
 public:
    OsmesaContext() {
        const int attributes[] = {OSMESA_FORMAT,
                                  OSMESA_RGBA,
                                  OSMESA_PROFILE,
                                  OSMESA_CORE_PROFILE,
                                  OSMESA_CONTEXT_MAJOR_VERSION,
                                  3,
                                  OSMESA_CONTEXT_MINOR_VERSION,
                                  3,
                                  0};
        context_ = create_(attributes, nullptr);
        if (!context_) throw std::runtime_error("OSMesa: cannot create an OpenGL 3.3 core context");
    }
    ~OsmesaContext() override { destroy_(context_); }

    void make_current() override {
        // OSMesa wants a picture of its own; ours is drawn into a framebuffer object instead, as with EGL.
        if (!current_(context_, unused_.data(), GL_UNSIGNED_BYTE, side, side))
            throw std::runtime_error("OSMesa: cannot make the OpenGL context current");
    }
    void release() override { current_(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }
    EntryPoint entry_point(const char* name) const override { return address_(name); }
    std::string library() const override { return "OSMesa"; }

 private:
    static constexpr int side = 16;

    Library library_{"libOSMesa.so.8", "libosmesa6"};
    decltype(&OSMesaCreateContextAttribs) create_ =
        library_.get<decltype(&OSMesaCreateContextAttribs)>("OSMesaCreateContextAttribs");
    decltype(&OSMesaDestroyContext) destroy_ =
        library_.get<decltype(&OSMesaDestroyContext)>("OSMesaDestroyContext");
    decltype(&OSMesaMakeCurrent) current_ = library_.get<decltype(&OSMesaMakeCurrent)>("OSMesaMakeCurrent");
    decltype(&OSMesaGetProcAddress) address_ =
        library_.get<decltype(&OSMesaGetProcAddress)>("OSMesaGetProcAddress");
    OSMesaContext context_ = nullptr;
    std::array<unsigned char, 4 * side * side> unused_{};
};

}  // namespace

#ifdef __SANITIZE_ADDRESS__
// Mesa 22.3 never frees the few bytes that describe OSMesa's own picture, once per context.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\n"; }
#endif

std::unique_ptr<Context> make_osmesa_context() { return std::make_unique<OsmesaContext>(); }

}  // namespace hibi
