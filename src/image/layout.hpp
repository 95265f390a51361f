#pragma once
#include <optional>

#include "image/camera.hpp"

namespace hibi {

/// Which parts a picture is asked to have.
struct Parts {
    bool title = true, subtitle = true;
    bool time = true, load = true, counts = true;
    bool colour_bar = true, legend = true, curve = true;
    bool scale_bar = true;
};

/// Where everything goes, in pixels. Parts that find no room are absent.
struct Layout {
    double unit = 1;   ///< lengths of lines and symbols: 1 in a picture 720 high (1280 x 720, 720 x 720)
    double text = 12;  ///< size of ordinary text; shrinks more slowly than the picture, never below 9
    double title_size = 23;
    Parts parts;           ///< what is shown
    PixelRect title;       ///< title and subtitle; height 0 where neither is shown
    PixelRect plot;        ///< the body
    PixelRect footer;      ///< scale bar at the left, event at the right; height 0 where there is no room
    PixelRect readout;     ///< time, load and counts, one under the other
    PixelRect colour_bar;  ///< title, bar and numbers
    PixelRect legend;
    PixelRect curve;  ///< axes and their titles included
};

/// Pictures at least 1.2 times as wide as high have a column at the right, others a band below. Where room is
/// short, parts go in this order: curve, legend, subtitle, counts, load, colour bar, scale bar, time, title.
/// Depends on nothing but size and wishes, so all frames and all runs of a comparison share it.
Layout lay_out(int width, int height, const Parts& wanted);

/// Height of the readout's rows (pixels), from the top: the time, then load and count.
inline constexpr double time_row = 1.9, readout_row = 1.55;  // times the text size

}  // namespace hibi
