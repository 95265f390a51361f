#pragma once
#include <memory>
#include <string>

#include "render/renderer.hpp"

namespace hibi {

/// An OpenGL 3.3 core context without a window. It is current only while a picture is drawn: the two
/// libraries share thread-local state, and neither notices when the other takes the thread over.
class Context {
 public:
    using EntryPoint = void (*)();

    Context() = default;
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    virtual void make_current() = 0;
    virtual void release() = 0;
    /// Never a test whether a function exists: OSMesa answers nonsense names with an address too.
    virtual EntryPoint entry_point(const char* name) const = 0;
    virtual std::string library() const = 0;  ///< "OSMesa" or "EGL"
};

std::unique_ptr<Context> make_osmesa_context();
std::unique_ptr<Context> make_egl_context();

/// Throws std::runtime_error naming the library, what failed and what to install.
std::unique_ptr<Context> make_context(GlBackend backend);

/// Makes a context current for a scope.
class CurrentContext {
 public:
    explicit CurrentContext(Context& context) : context_(context) { context_.make_current(); }
    ~CurrentContext() { context_.release(); }
    CurrentContext(const CurrentContext&) = delete;
    CurrentContext& operator=(const CurrentContext&) = delete;

 private:
    Context& context_;
};

/// A library opened at run time; its names stay its own. Never closed: Mesa leaves threads and exit handlers
/// behind that would run into unmapped code.
class Library {
 public:
    /// Throws std::runtime_error: what could not be opened, the loader's reason, and the package that has it.
    Library(const char* file, const char* package);

    template <class Function>
    Function get(const char* name) const {
        return reinterpret_cast<Function>(symbol(name));
    }

 private:
    void* symbol(const char* name) const;
    void* handle_ = nullptr;
    std::string file_;
};

}  // namespace hibi
