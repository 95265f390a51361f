#pragma once
#include <optional>
#include <string>

#include "image/figure.hpp"
#include "image/image.hpp"
#include "image/overlay.hpp"

namespace hibi {

/// What stands under the picture of a figure.
struct FigureScales {
    std::optional<ColourBar> colours{};  ///< a horizontal bar with round numbers
    double pixels_per_metre = 0;         ///< of the picture, for a scale bar; 0: none
    std::string note{};                  ///< in place of a colour bar
};

/// The picture with its scales below, as wide as it is.
Image with_scales(const Image& picture, const FigureScales& scales, const FigureStyle& style);

}  // namespace hibi
