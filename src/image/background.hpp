#pragma once
#include <functional>

#include "image/image.hpp"
#include "image/view.hpp"

namespace hibi {

/// Lets `draw` draw on the background that the view asks for: on the theme's, or, for none, on black and once
/// more on white, which together tell colour and alpha. `draw` fills the whole image and blends linearly.
void draw_on_background(const View& view, Image& image,
                        const std::function<void(const Rgb& background, Image& image)>& draw);

}  // namespace hibi
