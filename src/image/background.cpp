#include "image/background.hpp"

namespace hibi {

void draw_on_background(const View& view, Image& image,
                        const std::function<void(const Rgb& background, Image& image)>& draw) {
    image.transparent = false;
    if (!view.transparent) return draw(theme(view.theme).background, image);
    draw({0, 0, 0}, image);
    Image over_white(image.width, image.height);
    draw({1, 1, 1}, over_white);
    find_alpha(image, over_white);
}

}  // namespace hibi
