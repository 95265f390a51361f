#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hibi {

/// How a run is pictured: the [view] block of a scene.
struct View {
    int width = 1920, height = 1080;    ///< pixels; even
    std::string field = "bond_strain";  ///< what colours the particles: a name of scalar_field
    /// A name of colour_map_names(); absent: diverging for a signed field in the range of the run, else inferno.
    std::optional<std::string> map{};
    std::optional<std::array<double, 2>>
        range{};                 ///< in the field's SI unit; absent: fixed over the whole run
    std::string theme = "dark";  ///< dark, light, print
    bool transparent = false;    ///< no background, in files that can do without
    std::vector<std::string> show = all_parts();
    std::optional<std::array<double, 4>> window{};  ///< x0, y0, x1, y1 (m); absent: the run up to separation
    std::string bonds = "nearest";                  ///< which intact bonds are drawn: none, nearest, all
    double stroke = 1;                              ///< thickness of lines and symbols relative to what suits the size
    double magnify = 1;                             ///< displacements are drawn this many times as large

    static std::vector<std::string> all_parts() {
        return {"title", "time", "load", "counts", "colour_bar", "scale_bar", "supports", "loads", "curve"};
    }
    bool shows(const std::string& part) const {
        for (const std::string& s : show)
            if (s == part) return true;
        return false;
    }
};

}  // namespace hibi
