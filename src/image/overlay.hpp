#pragma once
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "image/camera.hpp"
#include "image/image.hpp"
#include "image/theme.hpp"
#include "image/view.hpp"

namespace hibi {

struct ColourBar {
    std::string title, unit;  ///< unit: SI symbol, prefixed as fits; "" for a plain number
    double low = 0, high = 1;
    std::string map = "inferno";
};

/// The growing inset: all points of the run; a frame draws those up to its time. Axes fixed over the run.
struct InsetCurve {
    std::string x_title{}, x_unit{}, y_title{}, y_unit{};
    std::vector<double> time{}, x{}, y{};
    std::vector<double> broken{};  ///< optional second line, a count on the same x
    struct Other {
        std::vector<double> time{}, x{}, y{};
    };
    std::vector<Other> others{};  ///< of other runs, in the colours of Theme::series behind the first
};

/// A support or load in pixels of one frame.
struct Symbol {
    enum class Kind {
        clamp,   ///< hatching along the outline of particles held both ways
        roller,  ///< circles under the outline of particles held one way
        arrow,   ///< one arrow per point, tails joined by a line
        notch    ///< a line through the points
    };
    Kind kind = Kind::clamp;
    std::vector<std::array<double, 2>>
        points;                             ///< centres of the particles along the outline, in order, y down
    double radius = 0;                      ///< of a particle (pixels)
    std::array<double, 2> outward{0, 0};    ///< clamp, roller: unit vector away from the body, y down
    std::array<double, 2> direction{0, 0};  ///< arrow: unit vector, y down
    double size = 1;                        ///< arrow: 0..1 of the full length
    bool pulls = false;                     ///< arrow: its tail touches the particle, else its head does
};
/// Lengths of symbols are multiples of this (pixels).
double symbol_unit(const View& view);
/// How far a symbol reaches beyond the edge of its particles (pixels), at full size.
double symbol_reach(Symbol::Kind kind, const View& view);

/// What stays the same in every frame.
struct OverlayContent {
    std::string title{}, subtitle{};
    ColourBar colour_bar{};
    InsetCurve curve{};          ///< fewer than two points: no inset
    bool has_breaks = false;     ///< the legend explains broken bonds
    std::string load_title{};    ///< e.g. "Load"; empty: no load is shown
    std::string load_unit{};     ///< "N"
    double load_max = 0;         ///< largest magnitude over the run: fixes prefix and decimals
    std::string time_symbol{"t"};
    double time_end = 0;         ///< of the run (s): fixes prefix
    double time_resolution = 0;  ///< smallest difference that the time has to show (s): fixes decimals
};

struct OverlayFrame {
    double time = 0;  ///< (s)
    double load = 0;
    int broken = 0;
    std::optional<std::string> event{};  ///< e.g. "First break", shown for a moment
    double event_strength = 1;           ///< 0..1, for fading out
    double speed = 1;  ///< playback speed relative to the film's usual one; shown when it is slow motion
    double pixels_per_metre = 1;
    std::vector<Symbol> symbols{};
};

/// Places and draws titles, time, load, colour bar, scale bar, legend, symbols and the inset with Cairo. The
/// layout depends on the size and on View::show alone: wide pictures have a column at the right, square and
/// tall ones a band below (layout.hpp). A glyph that neither font has is an error (std::runtime_error naming
/// the character), never a box. Not thread-safe.
class Overlay {
 public:
    Overlay(const View& view, OverlayContent content);
    ~Overlay();
    Overlay(const Overlay&) = delete;
    Overlay& operator=(const Overlay&) = delete;

    PixelRect plot() const;  ///< what is left for the body
    /// The image must have the view's size.
    void draw(Image& image, const OverlayFrame& frame) const;

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace hibi
