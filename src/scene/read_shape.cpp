#include "scene/read_shape.hpp"

namespace hibi {

std::optional<Shape<2>> read_shape(BlockReader& block, const std::string& key) {
    if (key == "box") {
        const auto corners = block.points(key);
        if (!corners) return {};
        if (corners->size() != 2) {
            block.fail(key, "box needs two corners",
                       "for example: box = [[\"0 m\", \"0 m\"], [\"40 m\", \"20 m\"]]");
            return {};
        }
        if (!(corners->at(0).array() < corners->at(1).array()).all()) {
            block.fail(key, "box needs its low corner first, then its high one");
            return {};
        }
        return Shape<2>{Box<2>{corners->at(0), corners->at(1)}};
    }
    if (key == "disc") {
        auto table = block.table(key);
        if (!table) return {};
        const auto centre = table->point("centre");
        const auto radius = table->quantity("radius");
        if (radius && !(*radius > 0)) table->fail("radius", "disc radius needs to be above 0");
        if (!centre || !radius) return {};
        return Shape<2>{Disc<2>{*centre, *radius}};
    }
    if (key == "ring") {
        auto table = block.table(key);
        if (!table) return {};
        const auto centre = table->point("centre");
        const auto inner = table->quantity("inner"), outer = table->quantity("outer");
        if (inner && !(*inner > 0))
            table->fail("inner", "ring inner needs to be above 0", "without a hole it is a disc");
        if (inner && outer && !(*inner < *outer))
            table->fail("outer", "ring outer needs to be larger than inner");
        if (!centre || !inner || !outer) return {};
        return Shape<2>{Ring<2>{*centre, *inner, *outer}};
    }
    if (key == "polygon") {
        const auto corners = block.points(key);
        if (!corners) return {};
        if (corners->size() < 3) {
            block.fail(key, "polygon needs three corners or more");
            return {};
        }
        return Shape<2>{Polygon{*corners}};
    }
    Difference<2> difference;
    for (BlockReader& part : block.tables("difference")) {
        const auto form = part.one_of({"box", "disc", "ring", "polygon"}, "shape");
        const auto shape = form ? read_shape(part, *form) : std::nullopt;
        if (shape) difference.parts.push_back(*shape);
    }
    if (difference.parts.size() < 2) {
        block.fail(key, "difference needs two shapes or more: the first less the others");
        return {};
    }
    return Shape<2>{difference};
}

}  // namespace hibi
