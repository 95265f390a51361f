#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "image/camera.hpp"
#include "image/image.hpp"
#include "image/theme.hpp"
#include "image/view.hpp"

namespace hibi {

struct ColourBar {
    std::string title, unit;   ///< unit: SI symbol, prefixed as fits; "" for a plain number
    double low = 0, high = 1;
    std::string map = "inferno";
};

/// The growing inset: all points of the run; a frame draws those up to its time. Axes fixed over the run.
struct InsetCurve {
    std::string title, x_title, x_unit, y_title, y_unit;
    std::vector<double> time, x, y;
    std::vector<double> broken;  ///< optional second line, a count on the same x
};

/// A support or load in pixels of this frame: the outline particles' centres and the particle radius.
struct Symbol {
    enum class Kind { clamp, roller_x, roller_y, arrow };  ///< roller_x: only x is held
    Kind kind = Kind::clamp;
    std::vector<std::array<double, 2>> points;   ///< pixel centres of its particles
    double radius = 0;                           ///< of a particle (pixels)
    std::array<double, 2> outward{0, 0};         ///< clamp, roller: unit vector away from the body, pixels, y down
    std::array<double, 2> direction{0, 0};       ///< arrow: unit vector, pixels, y down
    double size = 0;                             ///< arrow: 0..1 of the full length, at this time
};

/// What stays the same in every frame.
struct OverlayContent {
    std::string title, subtitle;
    ColourBar colour_bar;
    InsetCurve curve;
    bool has_breaks = false;   ///< the legend explains broken bonds
    std::string load_title;    ///< e.g. "Load"
    std::string load_unit;     ///< "N"
};

struct OverlayFrame {
    double time = 0;           ///< (s)
    double load = 0;
    int broken = 0;
    std::optional<std::string> event{};   ///< e.g. "first break", shown for a moment
    double speed = 1;          ///< playback speed relative to the film's usual one; shown when it is slow motion
    double pixels_per_metre = 1;
    std::vector<Symbol> symbols;
};

/// Places and draws titles, time, load, colour bar, scale bar, legend, symbols and the inset with Cairo. The layout
/// depends on the size alone: wide pictures have a column at the right, square and tall ones a band below.
/// A glyph that neither font has is an error (std::runtime_error naming the character), never a box.
class Overlay {
  public:
    Overlay(const View& view, OverlayContent content);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    PixelRect plot() const;    ///< what is left for the body
    void draw(Image& image, const OverlayFrame& frame) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hibi
