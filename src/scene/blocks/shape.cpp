#include "scene/blocks/blocks.hpp"

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

void read_box(BlockReader& block, Shape<2>& shape) {
    const auto corners = block.points("box");
    if (!corners) return;
    if (corners->size() != 2)
        block.fail("box", "box needs two corners",
                   "for example: box = [[\"0 m\", \"0 m\"], [\"40 m\", \"20 m\"]]");
    else if (!(corners->at(0).array() < corners->at(1).array()).all())
        block.fail("box", "box needs its low corner first, then its high one");
    else
        shape.form = Box<2>{corners->at(0), corners->at(1)};
}

void write_box(WrittenKeys& out, const Shape<2>& shape) {
    if (const auto* box = std::get_if<Box<2>>(&shape.form))
        out.add("box", toml_text(std::vector{box->low, box->high}));
}

void read_polygon(BlockReader& block, Shape<2>& shape) {
    const auto corners = block.points("polygon");
    if (!corners) return;
    shape.form = Polygon{*corners};
    if (corners->size() < 3)
        block.fail("polygon", "polygon needs three corners or more");
    else if (const auto crossing = sides_that_cross(*corners))
        block.fail(
            "polygon",
            fmt::format("polygon: its sides {} and {} cross; give the corners in order round the shape",
                        crossing->first + 1, crossing->second + 1));
}

void write_polygon(WrittenKeys& out, const Shape<2>& shape) {
    if (const auto* polygon = std::get_if<Polygon>(&shape.form))
        out.add("polygon", toml_text(polygon->corners));
}

Block<Disc<2>> disc_keys() {
    Block<Disc<2>> disc("disc", KeyBlock::Form::inner, "A full circle.", {Vec<2>::Zero()});
    disc.add("centre", &Disc<2>::centre, "m", "", R"(["0 m", "0 m"])", required);
    disc.add("radius", &Disc<2>::radius, "m", "", R"("1 m")", required, above(0));
    return disc;
}

Block<Ring<2>> ring_keys() {
    Block<Ring<2>> ring("ring", KeyBlock::Form::inner, "A circle with a hole.", {Vec<2>::Zero()});
    ring.add("centre", &Ring<2>::centre, "m", "", R"(["0 m", "0 m"])", required);
    ring.add("inner", &Ring<2>::inner, "m", "radius of the hole", R"("0.8 m")", required,
             above(0, "without a hole it is a disc"));
    ring.add("outer", &Ring<2>::outer, "m", "radius", R"("1 m")", required, above(0));
    ring.afterwards([](BlockReader& block, Ring<2>& its) {
        if (block.is_fine("inner") && block.is_fine("outer") && !(its.inner < its.outer))
            block.fail("outer", "ring outer needs to be larger than inner");
    });
    return ring;
}

/// A form with keys of its own, in a table.
template <class Form>
void add_form(Block<Shape<2>>& shape, const Block<Form>& form, const std::string& meaning,
              const std::string& example) {
    const std::string name = form.keys.name;
    shape.add_inner(form);
    shape.bound(
        {name, KeyKind::table, name, meaning, example},
        [=](BlockReader& block, Shape<2>& its) {
            if (auto table = block.table(name)) form.read(*table, its.form.emplace<Form>(form.initial));
        },
        [=](WrittenKeys& out, const Shape<2>& its) {
            if (const auto* written = std::get_if<Form>(&its.form))
                out.add(name, form.in_one_table(*written, out.scene));
        });
}

void add_difference(Block<Shape<2>>& shape) {
    const Block<Shape<2>> part = shape_keys(false);
    shape.add_inner(part);
    shape.bound(
        {"difference", KeyKind::tables, "difference", "the first shape less all the others",
         R"([{ box = [[0, 0], [4, 4]] }, { disc = { centre = [2, 2], radius = "1 m" } }])"},
        [part](BlockReader& block, Shape<2>& its) {
            if (!block.has("difference")) return;
            auto& parts = its.form.emplace<Difference<2>>().parts;
            for (BlockReader& table : block.tables("difference"))
                part.read(table, parts.emplace_back(part.initial));
            if (parts.size() < 2)
                block.fail("difference", "difference needs two shapes or more: the first less the others");
        },
        [part](WrittenKeys& out, const Shape<2>& its) {
            const auto* difference = std::get_if<Difference<2>>(&its.form);
            if (!difference) return;
            std::vector<std::string> parts;
            for (const Shape<2>& its_part : difference->parts)
                parts.push_back(part.in_one_table(its_part, out.scene));
            out.add("difference", toml_list(parts));
        });
}

}  // namespace

Block<Shape<2>> shape_keys(bool may_be_difference) {
    Block<Shape<2>> shape("difference", KeyBlock::Form::inner, "One shape of a difference.",
                          {Box<2>{Vec<2>::Zero(), Vec<2>::Zero()}});
    shape.bound({"box", KeyKind::points, "m",
                 "two corners; each side holds a whole number of spacings, unless the lattice is turned",
                 R"([["0 m", "0 m"], ["40 m", "20 m"]])"},
                read_box, write_box, by_default(""));
    add_form(shape, disc_keys(), "a full circle", R"({ centre = ["0 m", "0 m"], radius = "1 m" })");
    add_form(shape, ring_keys(), "a circle with a hole",
             R"({ centre = ["0 m", "0 m"], inner = "0.8 m", outer = "1 m" })");
    shape.bound({"polygon", KeyKind::points, "m", "corners, one after the other; no side crosses another",
                 R"([["0 m", "0 m"], ["4 m", "0 m"], ["0 m", "3 m"]])"},
                read_polygon, write_polygon);
    if (may_be_difference) add_difference(shape);
    shape.afterwards(
        [forms = shape.keys.key_names()](BlockReader& block, Shape<2>&) { block.one_of(forms, "shape"); });
    return shape;
}

}  // namespace hibi
