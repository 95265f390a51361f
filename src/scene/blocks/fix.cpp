#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

void read_hold(BlockReader& block, FixSpec& fix) {
    const auto axes = block.choices("hold");
    for (std::size_t i = 0; axes && i < axes->size(); ++i) {
        if (axes->at(i) == "z")
            block.fail(fmt::format("hold/{}", i), "[[fix]] hold: a plane model has no \"z\"");
        fix.axes[axes->at(i)[0] - 'x'] = true;
    }
}

void write_hold(WrittenKeys& out, const FixSpec& fix) {
    std::vector<std::string> axes;
    for (int axis = 0; axis < 3; ++axis)
        if (fix.axes[axis]) axes.emplace_back(1, static_cast<char>('x' + axis));
    out.add("hold", toml_text(axes));
}

}  // namespace

SceneBlock fix_block() {
    Block<FixSpec> fix("fix", KeyBlock::Form::list, "A support: particles held in place.");
    fix.name("for messages", R"("clamp")");
    fix.bound(
        {"where", KeyKind::condition, "", "which particles", R"("x < spacing")"},
        [](BlockReader& block, FixSpec& its) { set(its.where, block.condition("where")); },
        [](WrittenKeys& out, const FixSpec& its) {
            if (!its.where.text.empty()) out.add("where", toml_text(its.where.text));
        },
        by_default("required, unless body is given"));
    fix.body(
        "body", [](auto& its) -> auto& { return its.where.body; }, "only particles of this body",
        R"("plate")");
    fix.bound({"hold", KeyKind::names, "", "directions in which they cannot move; one alone is a roller",
               R"(["x", "y"])"},
              read_hold, write_hold, one_of({"x", "y", "z"}), required);
    fix.afterwards([](BlockReader& block, FixSpec&) {
        if (!block.has("where") && !block.has("body"))
            block.fail("where", "missing key \"where\" in [[fix]]", "for example: where = \"x < 1 m\"");
    });
    return list_block(fix, &Scene::fixes);
}

}  // namespace hibi
