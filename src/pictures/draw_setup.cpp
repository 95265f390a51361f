#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "image/background.hpp"
#include "image/overlay.hpp"
#include "image/png.hpp"
#include "pictures/draw.hpp"
#include "pictures/drawing_origin.hpp"
#include "pictures/notch_line.hpp"
#include "pictures/picture.hpp"
#include "pictures/run_drawing.hpp"
#include "pictures/symbol_anchors.hpp"
#include "record/provenance.hpp"
#include "scene/read.hpp"

namespace hibi {

void draw_setup(const BuiltScene& setup, const std::filesystem::path& png, const RendererOptions& options,
                const std::string& command) {
    if (png.extension() != ".png" || std::filesystem::is_directory(png))
        throw std::runtime_error(
            fmt::format("{}: is no name of a PNG file; write for example -o setup.png", png.string()));
    const Scene& scene = setup.scene;
    Topology topology = topology_of(scene, setup.built);
    View view = scene.view;
    const Vec3 origin = drawing_origin(topology, view.window);
    topology = counted_from(origin, std::move(topology));
    if (view.window) view.window = counted_from(origin, *view.window);
    view.map = "viridis";  // stands for the body's number here, not for a field
    view.show = {"title", "scale_bar", "supports", "loads"};
    const std::vector<SymbolAnchor> anchors =
        find_symbol_anchors(topology, scene.view.shows("supports"), scene.view.shows("loads"));
    const Overlay overlay(view, {.title = scene.title, .subtitle = describe(scene, topology)});
    Renderer renderer(view, topology, options);

    Picture2 picture;
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 4> box{far, far, -far, -far};
    std::vector<double> x, y;
    for (std::size_t i = 0; i < topology.reference_position.size(); ++i) {
        const Vec3& X = topology.reference_position[i];
        const double r = topology.spacing[i] / 2;
        box = {std::min(box[0], X.x() - r), std::min(box[1], X.y() - r), std::max(box[2], X.x() + r),
               std::max(box[3], X.y() + r)};
        x.push_back(X.x());
        y.push_back(X.y());
        picture.value.push_back((static_cast<float>(topology.body[i]) + 0.5f) /
                                static_cast<float>(topology.body_names.size()));
    }
    picture.x.assign(x.begin(), x.end());
    picture.y.assign(y.begin(), y.end());
    picture.intact = drawn_bonds(topology, view.bonds);
    std::vector<Reserved> reserved;
    for (const SymbolAnchor& anchor : anchors)
        for (const Reserved& r : reserve(anchor, x, y, 1, view)) reserved.push_back(r);
    if (const auto& w = view.window)
        picture.camera = Camera2::fit((*w)[0], (*w)[1], (*w)[2], (*w)[3], overlay.plot());
    else
        picture.camera = camera_for(box, reserved, overlay.plot());

    Image image(view.width, view.height);
    OverlayFrame over{.pixels_per_metre = picture.camera.scale, .symbols = {}};
    const double unit = symbol_unit(view);
    for (const SymbolAnchor& anchor : anchors)
        over.symbols.push_back(place_symbol(anchor, x, y, picture.camera, 1, unit));
    for (const NotchLine& notch : find_notches(topology))
        over.symbols.push_back(place_notch(notch, topology, x, y, picture.camera));
    draw_on_background(view, image, [&](const Rgb& background, Image& on) {
        renderer.draw(picture, background, on);
        overlay.draw(on, over);
    });
    write_png(png, image,
              {.text = to_texts({scene.title, HIBI_VERSION, scene_hash(scene), "", command}), .small = true});
}

}  // namespace hibi
