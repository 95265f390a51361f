#include "image/theme.hpp"
#include "results/snapshot.hpp"
#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

std::vector<std::pair<std::string, std::optional<std::string>>> maps() {
    std::vector<std::pair<std::string, std::optional<std::string>>> maps{{"auto", std::nullopt}};
    for (const std::string& name : colour_map_names()) maps.emplace_back(name, name);
    return maps;
}

Block<View> colour_keys() {
    Block<View> colour("colour", KeyBlock::Form::inner, "What colours the particles.");
    colour.add("field", &View::field, "", "", R"("von_mises")", one_of(scalar_field_names()));
    colour.choice_of("map", &View::map, maps(),
                     "auto: diverging for a signed field in the range of the run, else inferno",
                     R"("viridis")");
    colour.bound(
        {"range", KeyKind::range, "",
         R"("run": what occurs during the run; or [low, high] in the unit of the field)",
         R"(["0 MPa", "20 MPa"])"},
        [](BlockReader& block, View& view) {
            view.range = block.range("range", field_label(view.field).unit);
        },
        [](WrittenKeys& out, const View& view) {
            out.add("range", view.range ? toml_text(Vec<2>(view.range->at(0), view.range->at(1)))
                                        : toml_text(std::string("run")));
        },
        by_default("run"));
    return colour;
}

void read_window(BlockReader& block, View& view) {
    const auto corners = block.points("window");
    if (!corners) return;
    if (corners->size() == 2 && (corners->at(0).array() < corners->at(1).array()).all())
        view.window = {corners->at(0).x(), corners->at(0).y(), corners->at(1).x(), corners->at(1).y()};
    else
        block.fail("window", "[view] window needs two corners, the low one first");
}

void write_window(WrittenKeys& out, const View& view) {
    if (!view.window) return;
    const auto& [x0, y0, x1, y1] = *view.window;
    out.add("window", toml_text(std::vector<Vec<2>>{{x0, y0}, {x1, y1}}));
}

}  // namespace

SceneBlock view_block() {
    Block<View> view("view", KeyBlock::Form::single, "What the pictures look like.");
    view.size("size", &View::width, &View::height, "pixels, even numbers", "[1280, 720]");
    view.table(
        colour_keys(), [](auto& its) -> auto& { return its; }, "what colours the particles",
        R"({ field = "von_mises", map = "viridis" })");
    view.add("theme", &View::theme, "", "", R"("light")", one_of(theme_names()));
    view.choice_of(
        "background", &View::transparent, {{"theme", false}, {"transparent", true}},
        "transparent: none, in frames and in films of a format that has it (not mp4; gif without soft "
        "edges)",
        R"("transparent")");
    view.add("show", &View::show, "", "what stands beside the picture", R"(["title", "time"])",
             one_of(View::all_parts()), by_default("all of them"));
    view.bound({"window", KeyKind::points, "m", "two corners of the part of space that is shown",
                R"([["0 m", "0 m"], ["40 m", "20 m"]])"},
               read_window, write_window, by_default("the run up to separation"));
    view.add("bonds", &View::bonds, "", "which intact bonds are drawn", R"("all")",
             one_of(std::vector<std::string>{"none", "nearest", "all"}));
    view.add("magnify", &View::magnify, "", "displacements are drawn this many times as large", "100",
             above(0));
    return single_block(view, &Scene::view);
}

}  // namespace hibi
