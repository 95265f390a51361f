#pragma once
#include <array>

#include "render/renderer.hpp"

namespace hibi::pictures {

/// A picture whose world is its pixels turned upside down: (x, y) m lies at pixel (x, height - y).
struct Stage {
    View view;
    Topology body;
    Picture2 picture;

    Stage(int width, int height, const char* theme_name) {
        view.width = width;
        view.height = height;
        view.theme = theme_name;
        const PixelRect all{0, 0, double(width), double(height)};
        picture.camera = {1, width / 2.0, height / 2.0, all};
    }

    /// Returns its index. The spacing is in pixels too.
    int particle(double x, double y, double spacing, float value = 0.5f) {
        body.reference_position.push_back(Vec3(x, y, 0));
        body.spacing.push_back(spacing);
        picture.x.push_back(static_cast<float>(x));
        picture.y.push_back(static_cast<float>(y));
        picture.value.push_back(value);
        return static_cast<int>(body.spacing.size()) - 1;
    }

    int bond(int first, int second) {
        body.first.push_back(first);
        body.second.push_back(second);
        body.rest_length.push_back((body.reference_position[second] - body.reference_position[first]).norm());
        return static_cast<int>(body.first.size()) - 1;
    }
    void intact_bond(int first, int second) { picture.intact.push_back(bond(first, second)); }
    void broken_bond(int first, int second, float freshness) {
        picture.broken.push_back(bond(first, second));
        picture.freshness.push_back(freshness);
    }

    Image draw(const RendererOptions& options = {}) const {
        Image image;
        Renderer(view, body, options).draw(picture, image);
        return image;
    }
};

using Bytes = std::array<int, 3>;  ///< R, G, B

inline Bytes at(const Image& image, int x, int y) {
    const std::uint8_t* p = image.pixel(x, y);
    return {p[2], p[1], p[0]};
}
inline Bytes bytes(const Rgb& c) {
    return {int(c[0] * 255 + 0.5f), int(c[1] * 255 + 0.5f), int(c[2] * 255 + 0.5f)};
}
inline Bytes entry(const char* map, int index) {
    const auto& c = colour_map(map)[index];
    return {c[0], c[1], c[2]};
}

/// A plate of 12 x 8 particles 20 pixels apart with a crack through its middle: something of everything.
inline Stage cracked_plate(const char* theme_name = "dark") {
    Stage stage(320, 200, theme_name);
    const int columns = 12, rows = 8;
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i)
            stage.particle(40 + 20.3 * i + 0.7 * j, 30 + 19.6 * j + (i > 5 ? 3.0 : 0.0), 20,
                           float(i + j) / (columns + rows));
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const int k = j * columns + i;
            if (i == 5 && j > 2)
                stage.broken_bond(k, k + 1, float(j) / rows);
            else if (i + 1 < columns)
                stage.intact_bond(k, k + 1);
            if (j + 1 < rows) stage.intact_bond(k, k + columns);
        }
    return stage;
}

}  // namespace hibi::pictures
