#include <algorithm>

#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

constexpr std::array kinds{"force", "pressure", "displacement", "velocity"};  // in the order of Load::Kind

/// What is loaded: a face of a body, or the particles of a selection.
void read_target(BlockReader& block, LoadSpec& load) {
    const auto body = block.body("body");
    load.face = block.choice("face");
    if (block.has("face")) {
        if (block.has("where")) block.fail("face", "[[load]] has both where and face", "keep one of them");
        const auto& bodies = block.scene().bodies;
        load.face_body = body ? *body : !block.has("body") && bodies.size() == 1 ? 0 : -1;
        if (!block.has("body") && bodies.size() > 1)
            block.fail("face", "[[load]] face: of which body?",
                       fmt::format("add body = \"{}\"", bodies.front().name));
    } else if (block.has("where") || block.has("body")) {
        load.where.emplace();
        set(*load.where, block.condition("where"));
        set(load.where->body, body);
    } else {
        block.fail("where", "missing key \"where\" in [[load]]",
                   "for example: where = \"x > 39 m\", or face = \"right\"");
    }
}

void write_target(WrittenKeys& out, const LoadSpec& load) {
    const auto add_body = [&](int index) {
        if (index >= 0) out.add("body", toml_text(out.scene.bodies[index].name));
    };
    if (load.where) {
        if (!load.where->text.empty()) out.add("where", toml_text(load.where->text));
        add_body(load.where->body);
    }
    if (load.face) {
        out.add("face", toml_text(*load.face));
        add_body(load.face_body);
    }
}

/// The kind of the load and its value, by one of four keys.
void read_value(BlockReader& block, LoadSpec& load) {
    if (block.has("pulse")) block.silence("value");
    const auto key = block.one_of({kinds.begin(), kinds.end()}, "value");
    if (!key) return;
    load.kind = static_cast<Load::Kind>(std::find(kinds.begin(), kinds.end(), *key) - kinds.begin());
    if (load.kind == Load::Kind::pressure) {
        set(load.value[0], block.field(*key, true));
        return;
    }
    const bool prescribed = load.kind != Load::Kind::force;
    const auto value = block.vector(*key, true, prescribed);
    if (!value) return;
    for (int axis = 0; axis < 2; ++axis) {
        set(load.value[axis], value->at(axis));
        load.driven[axis] = prescribed && value->at(axis).has_value();
    }
    if (prescribed && !load.driven[0] && !load.driven[1])
        block.fail(*key, fmt::format("[[load]] {}: both directions are free", *key), "then it is no load");
}

void write_value(WrittenKeys& out, const LoadSpec& load) {
    const auto component = [&](int axis) {
        return load.kind == Load::Kind::force || load.driven[axis] ? toml_text(load.value[axis])
                                                                   : std::string("\"free\"");
    };
    out.add(kinds[static_cast<int>(load.kind)], load.kind == Load::Kind::pressure
                                                    ? toml_text(load.value[0])
                                                    : toml_list({component(0), component(1)}));
}

void check_loads(const Scene& scene, Problems& problems) {
    bool primary = false;
    for (std::size_t k = 0; k < scene.loads.size(); ++k) {
        const LoadSpec& load = scene.loads[k];
        const std::string path = fmt::format("load/{}", k), face = path + "/face";
        if (load.primary && primary)
            problems.add(path + "/primary", "[[load]] primary: another load is primary already",
                         "one load drives the curve");
        primary |= load.primary;
        if (!load.face) continue;
        if (load.kind != Load::Kind::force && load.kind != Load::Kind::pressure)
            problems.add(face, "[[load]] face goes with force or pressure",
                         "select the particles by where = ...");
        if (problems.fine(face) && problems.fine(path + "/body") && load.face_body >= 0 &&
            problems.fine(fmt::format("body/{}", load.face_body)) &&
            !std::holds_alternative<Box<2>>(scene.bodies[load.face_body].shape.form))
            problems.add(
                face, fmt::format("[[load]] face: body \"{}\" is no box", scene.bodies[load.face_body].name),
                "select the particles by where = ...");
    }
}

}  // namespace

SceneBlock load_block() {
    Block<LoadSpec> load(
        "load", KeyBlock::Form::list,
        "A load: exactly one of force, pressure, displacement, velocity, on a selection or on "
        "a face.");
    load.name("column load.NAME of history.csv", R"("tip")");
    load.bound({"where", KeyKind::condition, "", "which particles", R"("x > 39 m")"}, read_target,
               write_target, by_default("required, unless face or body is given"));
    load.described({"body", KeyKind::text, "",
                    "only particles of this body; with face: the body it belongs to", R"("plate")"},
                   by_default("all bodies"));
    load.described({"face", KeyKind::text, "", "a side of a box, for force or pressure", R"("right")"},
                   one_of({"left", "right", "bottom", "top"}));
    load.bound(
        {"force", KeyKind::vector, "N",
         "total force; with where in equal shares, with face by the face's areas", R"(["0 N", "-80 MN"])"},
        read_value, write_value, may_vary, by_default(""));
    load.described(
        {"pressure", KeyKind::quantity, "Pa", "pushes into the body; negative pulls", R"("2 MPa")"},
        may_vary);
    load.described({"displacement", KeyKind::vector, "m", R"(prescribed; "free" leaves a direction alone)",
                    R"(["1 mm", "free"])"},
                   may_vary);
    load.described({"velocity", KeyKind::vector, "m/s", R"(prescribed; "free" leaves a direction alone)",
                    R"(["free", "-3 m/s"])"},
                   may_vary);
    load.described({"pulse", KeyKind::table, "", "a pressure pulse", "{ }"}, not_available_yet);
    load.add("ramp", &LoadSpec::ramp, "s",
             "grows evenly from nothing to the full value in this time, then stays", R"("40 s")",
             at_least(0));
    load.add("until", &LoadSpec::until, "", "when it is taken away", R"("separation")", by_default("never"),
             ends_something);
    load.add("primary", &LoadSpec::primary, "", "drives the curve and the events; one load at most", "true",
             by_default("true for the first load if none says so"));
    load.add("no_fail", &LoadSpec::no_fail, "", "bonds between two of its particles never break", "true");

    SceneBlock result = list_block(load, &Scene::loads);
    result.read = [read = result.read](const Value& document, ReadContext& context, Scene& scene) {
        read(document, context, scene);
        if (!scene.loads.empty() && std::ranges::none_of(scene.loads, &LoadSpec::primary))
            scene.loads.front().primary = true;
    };
    result.checks.push_back(check_loads);
    return result;
}

}  // namespace hibi
