#pragma once
#include <array>
#include <string>
#include <vector>

namespace hibi {

using Rgb = std::array<float, 3>;  ///< 0..1, sRGB

/// Every colour that is not a colour map's. Themes: dark, light, print (white, black lines, no gradients).
struct Theme {
    Rgb background, text, faint_text, line, grid;
    Rgb support, load;           ///< engineering symbols
    Rgb body;                    ///< particles that no field colours
    Rgb bond;                    ///< intact bonds
    Rgb crack_fresh, crack_old;  ///< a flash when fresh, then a trace
    Rgb curve, curve_second;     ///< same as load, and as a crack: what belongs together has one colour
    std::array<Rgb, 6> series;   ///< lines of a chart, told apart also by the colour-blind
    float rim = 0.35f;           ///< how much a particle's edge is darkened, 0..1
};
/// Throws std::out_of_range for a name not in theme_names().
const Theme& theme(const std::string& name);
const std::vector<std::string>& theme_names();

/// 256 colours, 8 bits each, dark end first.
using ColourMap = std::array<std::array<unsigned char, 3>, 256>;
/// viridis, cividis, inferno (trimmed at the dark end so that it stands out from a dark background),
/// diverging (for signed values: its middle is inferno's dark end, its upper half inferno, its lower half as
/// bright in blue); and, for marks on a plain body, viridis_on_dark and viridis_on_light, without the end that
/// would drown there. Throws std::out_of_range for a name not in colour_map_names().
const ColourMap& colour_map(const std::string& name);
const std::vector<std::string>& colour_map_names();

}  // namespace hibi
