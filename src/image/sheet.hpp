#pragma once
#include <string>
#include <vector>

#include "image/figure.hpp"
#include "image/image.hpp"

namespace hibi {

/// A picture with two lines under it.
struct Panel {
    Image image;
    std::string label, detail;  ///< detail may be empty in all panels
};

/// Width of a panel's picture (pixels).
int panel_width(int columns, const FigureStyle& style);

/// Panels of one size in rows, labels below, a title on top unless it is empty. Lines that are too long are
/// broken once, then shortened.
Image make_sheet(const std::vector<Panel>& panels, const std::string& title, int columns,
                 const FigureStyle& style);

}  // namespace hibi
