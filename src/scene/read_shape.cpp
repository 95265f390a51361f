#include "scene/read_shape.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hibi {

namespace {

/// Two sides that cross each other, by the number of their first corner. Every pair is looked at, so very
/// long outlines, which are drawn by programs, are taken as they are.
std::optional<std::pair<int, int>> sides_that_cross(const std::vector<Vec<2>>& corners) {
    constexpr int most = 2000;
    const int n = static_cast<int>(corners.size());
    if (n > most) return {};
    const auto side = [](const Vec<2>& a, const Vec<2>& b, const Vec<2>& p) {
        return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
    };
    for (int i = 0; i < n; ++i) {
        for (int j = i + 2; j < n; ++j) {
            if (i == 0 && j == n - 1) continue;  // they share a corner
            const Vec<2>&a = corners[i], &b = corners[(i + 1) % n], &c = corners[j],
                  &d = corners[(j + 1) % n];
            if (side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0)
                return std::pair{i, j};
        }
    }
    return {};
}

}  // namespace

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
        if (const auto crossing = sides_that_cross(*corners))
            block.fail(
                key,
                fmt::format("polygon: its sides {} and {} cross; give the corners in order round the shape",
                            crossing->first + 1, crossing->second + 1));
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
