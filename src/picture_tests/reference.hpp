#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "record/difference.hpp"
#include "record/run_folder.hpp"
#include "render/renderer.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// What made pictures: those of one key are equal to the last bit, those of two only within a tolerance.
struct PictureKey {
    std::string renderer;  ///< Renderer::description without the library, since OSMesa and EGL give the same
    std::string cpu;       ///< cpu_class()
    bool operator==(const PictureKey&) const = default;
};
PictureKey key_of(const std::string& renderer_description);

/// "x86-64-v3" and the like: which instructions the renderer and the C library choose by. With llvmpipe's
/// override in the environment (GALLIUM_OVERRIDE_CPU_CAPS) that, too.
std::string cpu_class();

/// A moment's picture. Several moments at one time share a file.
struct ReferenceFrame {
    std::string moment;       ///< as file names have it: "first_break", "separation+0.2s", "at_2s"
    std::string file;         ///< in the folder of the references
    double time = 0;          ///< (s)
    std::string sha256;       ///< pixel_hash
    std::int64_t step = 0;    ///< of the last state recorded by then
    double displacement = 0;  ///< root mean square over the particles in that state (m)
};

/// What a test compares: the pictures of a scene and the numbers that say whether the physics is the same.
struct Reference {
    PictureKey key;
    std::string version, scene_hash;
    std::vector<ReferenceFrame> frames;

    int particles = 0, bonds = 0, broken = 0;
    double spacing = 0;  ///< the smallest (m)
    double time_step = 0, end_time = 0;
    Events events;
    struct Break {
        int first = 0, second = 0;  ///< particles
        std::int64_t step = 0;
        bool operator==(const Break&) const = default;
    };
    static constexpr std::size_t most_breaks = 200;
    std::vector<Break> breaks;  ///< the first of them
};

/// references/NAME beside the scene.
std::filesystem::path reference_folder(const std::filesystem::path& scene);
/// Nothing where there is no references.json. Throws std::invalid_argument naming a file that is damaged.
std::optional<Reference> read_reference(const std::filesystem::path& folder);
void write_reference(const std::filesystem::path& folder, const Reference& reference);

/// The moments of [test] frames that happened in a run, drawn at the size of the test.
struct DrawnTest {
    Reference reference;        ///< what a reference of this run would hold
    std::vector<Image> images;  ///< per frame of it; empty where an earlier one has the same file
    const Image& image_of(const std::string& file) const;
};
DrawnTest draw_test(const Scene& scene, const RunReader& run, const RendererOptions& options);

/// What changed first in the physics, in one line as physics_verdict has it; empty where nothing did.
std::string physics_change(const Reference& expected, const Reference& actual, const RunTolerance& tolerance);

}  // namespace hibi
