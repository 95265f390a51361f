#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "image/camera.hpp"
#include "image/figure.hpp"
#include "image/image.hpp"

namespace hibi {

/// One line of a chart; values in SI units, a value that is not finite leaves a gap.
struct ChartLine {
    std::string label{};  ///< shown where there are several lines with one; empty: none
    std::vector<double> x{}, y{};
    int colour = 0;  ///< of Theme::series
    bool line = true, points = false, dashed = false;
};

struct ChartAxis {
    std::string title{}, unit{};  ///< unit: SI symbol, prefixed as fits; "" for a plain number
    bool logarithmic = false;     ///< values that are not above zero are left out
    bool from_zero = true;        ///< a linear axis reaches to zero, whatever the values
    std::optional<std::array<double, 2>> range{};  ///< its ends, whatever the values; lines are cut there
};

/// Something that happened: a dot on a curve, or, without y, a thin vertical line.
struct ChartMark {
    double x = 0;
    std::optional<double> y{};
    std::string label{};
};

struct Chart {
    std::string title{};  ///< may be empty
    ChartAxis x{}, y{};
    std::vector<ChartLine> lines{};
    std::vector<ChartMark> marks{};
    std::string note{};  ///< a line or more below; may be empty
};

/// Where the data are in a finished picture.
struct ChartPlace {
    PixelRect axes;                  ///< in points of the SVG
    std::array<double, 2> x{}, y{};  ///< values at left and right, at bottom and top (SI)
    bool x_logarithmic = false, y_logarithmic = false;

    double pixel_x(double value) const;  ///< in points
    double pixel_y(double value) const;
};

/// Charts side by side where each has 75 mm or more, else one below the other; all in one picture as wide as
/// the style says. Round numbers at the axes, one SI prefix per axis. Lines are named at their ends where
/// they all end at the right and there is room, else by a legend above the axes. Labels of marks stand where
/// they hide no data, as near as that allows. Throws std::runtime_error as Typesetter does.
Image chart_image(const std::vector<Chart>& charts, const FigureStyle& style);
/// The same as SVG: as wide in millimetres, its own lengths in points, text as outlines, so that it needs no
/// font, and no names (id), so that several fit into one page; the same bytes for the same charts. `metadata`
/// is kept in an element of that name.
std::string chart_svg(const std::vector<Chart>& charts, const FigureStyle& style,
                      std::vector<ChartPlace>* places = nullptr, std::string metadata = {});

}  // namespace hibi
