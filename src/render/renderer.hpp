#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/stage_time.hpp"
#include "image/camera.hpp"
#include "image/image.hpp"
#include "image/theme.hpp"
#include "image/view.hpp"
#include "results/snapshot.hpp"

namespace hibi {

/// Which library makes the OpenGL context. Both give the same pixels.
enum class GlBackend { osmesa, egl };

/// Where shaders come from: those built into the program, or a folder, so that a look can be tuned without
/// compiling.
struct RendererOptions {
    GlBackend backend = GlBackend::osmesa;
    std::optional<std::filesystem::path> shaders{};
    StageTimes* profile = nullptr;  ///< where the times of a frame's stages go, if anywhere
};

/// One moment, ready to be drawn.
struct Picture2 {
    Camera2 camera;
    std::vector<float> x, y;  ///< current positions (m), displacement magnified as the view asks
    std::vector<float>
        value{};              ///< 0..1 per particle: place in the colour map; empty: the theme's body colour
    std::vector<int> intact;  ///< bonds to draw as intact
    std::vector<int> broken;  ///< bonds to draw as crack faces
    std::vector<float> freshness;  ///< per broken bond: 1 just broken .. 0 old trace
    std::vector<float>
        history{};  ///< per broken bond: 0..1, place in the colour map; empty: the theme's colours
};

/// Draws particles, intact and broken bonds on the theme's background. Intact bonds between neighbours also
/// fill the body between its discs, so a crack, a notch or a flying piece shows as a gap; their lines fade
/// out where particles lie closer than 24 to 12 pixels. A broken bond is a mark across its middle, the longer
/// the bond the slighter, which fades while its ends part by 0.25 to 1.5 spacings. Widths grow with the
/// picture's height. Not thread-safe, and it must be used on the thread that made it. Errors:
/// std::runtime_error naming the library or the shader.
class Renderer {
 public:
    /// The topology is kept as a reference.
    Renderer(const View& view, const Topology& topology, const RendererOptions& options = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Fills the whole image (view size) with a colour, and draws the picture on it, clipped to camera.rect.
    /// Whatever the colour, the border of a crack is that of the theme's background: it is part of the crack.
    void draw(const Picture2& picture, const Rgb& background, Image& image);
    void draw(const Picture2& picture, Image& image);  ///< on the theme's background

    /// Are intact bonds seen at all? Where particles lie close enough, their discs alone cover the body.
    bool shows_bonds(const Camera2& camera) const;

    /// e.g. "llvmpipe (LLVM 15.0.6, 256 bits), Mesa 22.3.6, OSMesa"
    std::string description() const;

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hibi
