#pragma once
#include <array>
#include <string>
#include <vector>

#include "app/film_plan.hpp"
#include "app/marks.hpp"
#include "app/notch_line.hpp"
#include "app/picture.hpp"
#include "image/overlay.hpp"
#include "record/run_folder.hpp"
#include "render/renderer.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// One recorded run, ready to be drawn frame by frame. What is fixed over the run (window, colours, axes,
/// prefixes) is settled by the constructor. Everything on the thread that made it.
class RunDrawing {
 public:
    RunDrawing(const Scene& scene, const RunReader& run, const RendererOptions& options);

    const FilmPlan& plan() const { return plan_; }
    std::string renderer() const { return renderer_.description(); }
    /// The picture of a frame, everything included; cheapest in rising order. Returns how many bonds it shows
    /// as broken.
    int draw(int frame, Image& image);

 private:
    double load_size(int load, double time) const;
    OverlayContent content(const Scene& scene) const;
    Camera2 camera();

    const RunReader& run_;
    View view_;
    std::array<double, 2> range_;
    double until_;  ///< of what counts: separation, or infinity (s)
    FilmPlan plan_;
    PictureSource source_;
    Overlay overlay_;
    Renderer renderer_;
    std::vector<Mark> marks_;
    std::vector<NotchLine> notches_;
    Camera2 camera_{};
    double unit_;                  ///< Layout::unit
    std::vector<double> largest_;  ///< per load: largest magnitude of what its arrows show
};

/// Counts and materials of a run in one line.
std::string describe(const Scene& scene, const Topology& topology);

}  // namespace hibi
