#pragma once
#include <optional>
#include <string>
#include <vector>

#include "image/image.hpp"
#include "pictures/run_drawing.hpp"

namespace hibi {

/// A moment worth a picture of its own.
struct KeyMoment {
    double time = 0;     ///< simulated (s)
    std::string label;   ///< "First break", "Start", "Separation + 0.2 s"; several at once joined by a comma
    std::string detail;  ///< time, and load where there is one: "t = 17.6 s, 35.2 MN"
};

/// The moments of [strip] at that happened, in rising order, those at the same time as one.
std::vector<KeyMoment> key_moments(const Scene& scene, const RunReader& run);

/// The body with supports, loads, notches and cracks at a moment, nothing beside it, as a figure for print:
/// `width` pixels wide, as high as the body asks for, lines as thick as text of `text` pixels wants them. All
/// moments of a run have the same size and colours.
class StillDrawing {
 public:
    StillDrawing(const Scene& scene, const RunReader& run, const std::string& theme, int width, double text,
                 const RendererOptions& options);
    Image draw(double time);  ///< (s)

 private:
    StillDrawing(const Scene& scene, const RunReader& run, DrawingStyle style,
                 const RendererOptions& options);

    int width_, height_;
    RunDrawing drawing_;
};

/// The whole failure in one still: the unloaded body, and across each bond that broke a mark coloured by
/// when.
class HistoryDrawing {
 public:
    /// As for StillDrawing.
    HistoryDrawing(const Scene& scene, const RunReader& run, const std::string& theme, int width, double text,
                   const RendererOptions& options);
    Image draw();
    /// Title, times and map of the colours; nothing where no bond broke.
    std::optional<ColourBar> colours() const { return colours_; }
    double pixels_per_metre() const { return drawing_.pixels_per_metre(); }

 private:
    HistoryDrawing(const Scene& scene, const RunReader& run, DrawingStyle style,
                   const RendererOptions& options);

    double end_;  ///< of the run (s)
    int width_, height_;
    std::optional<ColourBar> colours_;
    RunDrawing drawing_;
};

}  // namespace hibi
