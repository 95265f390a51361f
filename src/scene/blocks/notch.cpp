#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

/// The path of the cut, by one of two keys.
void read_path(BlockReader& block, Notch<2>& notch) {
    const auto form = block.one_of({"line", "polyline"}, "path");
    if (!form) return;
    set(notch.points, block.points(*form));
    const std::size_t count = notch.points.size();
    const bool line = *form == "line";
    if (block.is_fine(*form) && (count < 2 || (line && count > 2)))
        block.fail(*form, fmt::format("[[notch]] {} needs {}; found {}", *form,
                                      line ? "two points" : "two points or more", count));
}

void check_points(const Scene& scene, Problems& problems) {
    for (std::size_t k = 0; k < scene.notches.size(); ++k) {
        const auto& points = scene.notches[k].points;
        for (std::size_t i = 1; i < points.size(); ++i)
            if (points[i] == points[i - 1])
                problems.add(fmt::format("notch/{}", k), "[[notch]]: two points in a row are the same");
    }
}

}  // namespace

SceneBlock notch_block() {
    Block<Notch<2>> notch("notch", KeyBlock::Form::list,
                          "A cut made before the run; exactly one of line and polyline.");
    notch.name("for messages", R"("slit")");
    notch.described({"line", KeyKind::points, "m", "two points; bonds that cross or touch the cut are gone",
                     R"([["0 m", "10 m"], ["5 m", "10 m"]])"});
    notch.bound(
        {"polyline", KeyKind::points, "m", "two points or more",
         R"([["0 m", "10 m"], ["5 m", "10 m"], ["6 m", "12 m"]])"},
        read_path, [](WrittenKeys& out, const Notch<2>& its) { out.add("polyline", toml_text(its.points)); },
        by_default(""));
    notch.body("body", &Notch<2>::body, "the only body it cuts", R"("plate")");
    SceneBlock result = list_block(notch, &Scene::notches);
    result.checks.push_back(check_points);
    return result;
}

}  // namespace hibi
