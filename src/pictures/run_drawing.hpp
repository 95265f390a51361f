#pragma once
#include <array>
#include <string>
#include <vector>

#include "image/overlay.hpp"
#include "pictures/film_plan.hpp"
#include "pictures/notch_line.hpp"
#include "pictures/picture.hpp"
#include "pictures/symbol_anchors.hpp"
#include "record/run_folder.hpp"
#include "render/renderer.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// How a run is pictured.
struct DrawingStyle {
    View view;
    std::string title;
    std::array<double, 2> range{0, 1};  ///< of the colours, in the field's SI unit
    FilmPlan plan;
    Vec3 origin = Vec3::Zero();  ///< that positions in the picture are counted from (m)
    /// Of the body, in place of that of its run, counted from the origin (m).
    std::optional<std::array<double, 4>> window{};
    /// Crack history: the unloaded body in one colour, each broken bond coloured by its time of breaking,
    /// `range` being in seconds.
    bool history = false;
    bool event_labels = true;  ///< events are named in the picture while they happen
};
/// The style of the scene's own film.
DrawingStyle film_style(const Scene& scene, const RunReader& run);

/// One recorded run, ready to be drawn at any moment. What is fixed over the run (window, colours, axes,
/// prefixes) is settled by the constructor. Everything on the thread that made it.
class RunDrawing {
 public:
    RunDrawing(const Scene& scene, const RunReader& run, DrawingStyle style, const RendererOptions& options);

    const FilmPlan& plan() const { return style_.plan; }
    std::string renderer() const { return renderer_.description(); }
    /// The picture of a frame, everything included; cheapest in rising order. Returns how many bonds it shows
    /// as broken. What frame `next` needs is read meanwhile.
    int draw(int frame, Image& image, std::optional<int> next = {});
    /// The picture of a simulated time (s) as the film shows it, without the label of an event.
    int draw_at(double time, Image& image);
    PixelRect plot() const { return overlay_.plot(); }  ///< the part of the picture that holds the body
    double pixels_per_metre() const { return camera_.scale; }

 private:
    int draw(double time, double film_time, OverlayFrame over, Image& image, std::optional<double> next);
    void place_symbols(double time, OverlayFrame& over) const;
    double load_size(int load, double time) const;
    OverlayContent content(const Scene& scene) const;
    Camera2 camera();

    const RunReader& run_;
    const Topology& topology_;  ///< of the run, positions counted from the style's origin
    StageTimes* profile_;
    DrawingStyle style_;
    double until_;  ///< of what counts: separation, or infinity (s)
    PictureSource source_;
    Overlay overlay_;
    Renderer renderer_;
    std::vector<SymbolAnchor> anchors_;
    std::vector<NotchLine> notches_;
    Camera2 camera_{};
    double unit_;                  ///< Layout::unit
    std::vector<double> largest_;  ///< per load: largest magnitude of what its arrows show
};

/// The primary load at any moment (N), straight lines between the rows of the history.
double load_at(const History& history, double time);

/// Counts and materials of a run in one line.
std::string describe(const Scene& scene, const Topology& topology);

}  // namespace hibi
