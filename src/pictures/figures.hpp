#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "image/figure.hpp"
#include "image/image.hpp"
#include "record/run_folder.hpp"
#include "render/renderer.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// strip.png (key frames), cracks.png (crack history coloured by time), curve.png and curve.svg (load and
/// energies) of a recorded run, 170 mm wide at 300 dpi in the scene's theme; and in figures/ the same for
/// print in both usual widths, NAME_print_85mm.png and so on. Pictures of an earlier drawing are removed
/// first.
void draw_figures(const Scene& scene, const RunReader& run, const RendererOptions& renderer);

/// The crack history with its scales.
Image cracks_image(const Scene& scene, const RunReader& run, const FigureStyle& style,
                   const RendererOptions& renderer);

struct FiguresOptions {
    std::filesystem::path folder;                   ///< of the run
    std::vector<std::string> themes{};              ///< empty: the scene's
    std::vector<double> widths{170};                ///< (mm)
    std::optional<std::filesystem::path> output{};  ///< folder; absent: figures/ of the run
    RendererOptions renderer{};
};
/// The figures in other themes and widths. Returns the files written.
std::vector<std::filesystem::path> draw_figures_again(const FiguresOptions& options);

struct StripOptions {
    std::filesystem::path folder;                   ///< of the run
    std::optional<std::filesystem::path> output{};  ///< PNG; absent: strip.png of the run
    std::string theme{};                            ///< empty: the scene's
    double width_mm = 170;
    int columns = 0;  ///< pictures in a row; 0: as many as stay readable
    RendererOptions renderer{};
};
/// The key frames once more, in one picture. Returns its file.
std::filesystem::path draw_strip(const StripOptions& options);

}  // namespace hibi
