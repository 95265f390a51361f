#include "scene/read_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/read_shape.hpp"
#include "scene/suggest.hpp"

namespace hibi {

namespace {

/// Damping ratio of the first mode at which a load on a slow ramp finds the body nearly at its static state:
/// enough to still the swing within a period or two, and little lag.
constexpr double quasi_static_ratio = 0.3;

/// Sets a value that was read; keeps the default otherwise.
template <class To, class From>
void set(To& to, const std::optional<From>& from) {
    if (from) to = *from;
}

/// The key `seed` of a block.
std::optional<std::uint64_t> seed_of(BlockReader& block) {
    const auto seed = block.integer("seed");
    if (seed && *seed < 0)
        block.fail("seed", fmt::format("{} seed needs a whole number, 0 or more", block.name()));
    return seed ? std::optional(static_cast<std::uint64_t>(*seed)) : std::nullopt;
}

/// The one [block] of a document, if it is there and is a table.
std::optional<BlockReader> single(const Value& document, ReadContext& context, const std::string& name) {
    const Value* value = document.find(name);
    if (!value || value->kind != Value::Kind::table) return {};
    const KeyBlock& block = scene_block(name);
    return BlockReader(context, *value, block, name, block.title);
}

/// The tables of [[block]].
std::vector<BlockReader> list(const Value& document, ReadContext& context, const std::string& name) {
    std::vector<BlockReader> readers;
    const Value* value = document.find(name);
    if (!value || value->kind != Value::Kind::array) return readers;
    const KeyBlock& block = scene_block(name);
    for (std::size_t i = 0; i < value->items.size(); ++i)
        if (value->items[i].kind == Value::Kind::table)
            readers.emplace_back(context, value->items[i], block, fmt::format("{}/{}", name, i), block.title);
    return readers;
}

void read_model(BlockReader block, Scene& scene) {
    if (const auto dimension = block.integer("dimension")) {
        if (*dimension == 3)
            block.fail("dimension", "[model] dimension: three dimensions are not available yet");
        else if (*dimension != 2)
            block.fail("dimension", "[model] dimension needs 2 or 3");
    }
    if (const auto name = block.choice("assumption"))
        scene.assumption = *name == "plane strain" ? Assumption::plane_strain : Assumption::plane_stress;
    set(scene.thickness, block.quantity("thickness"));
    set(scene.influence, block.quantity("influence"));
    if (const auto name = block.choice("elasticity"))
        scene.elasticity = *name == "thesis" ? Elasticity::thesis : Elasticity::moment_matched;
}

void read_materials(const Value& document, ReadContext& context, Scene& scene) {
    const Value* value = document.find("material");
    if (!value || value->kind != Value::Kind::table) return;
    context.problems.stands_at("material", value->place);
    for (const Entry& entry : value->entries) {
        const std::string path = fmt::format("material/{}", scene.materials.size());
        if (entry.value.kind != Value::Kind::table) {
            context.problems.add(
                path, entry.place,
                fmt::format("[material] holds materials by name; found the key \"{}\"", entry.key),
                "write [material.NAME] above it");
            return;
        }
        BlockReader block(context, entry.value, scene_block("material"), path,
                          fmt::format("[material.{}]", entry.key));
        Material material;
        material.name = entry.key;
        set(material.density, block.quantity("density"));
        set(material.youngs_modulus, block.quantity("youngs_modulus"));
        set(material.poissons_ratio, block.quantity("poissons_ratio"));
        material.break_strain = block.quantity("break_strain");
        material.fracture_energy = block.quantity("fracture_energy");
        set(material.tension_only, block.flag("tension_only"));
        if (auto weibull = block.table("weibull")) {
            material.weibull.emplace();
            set(material.weibull->shape, weibull->quantity("shape"));
            set(material.weibull->seed, seed_of(*weibull));
        }
        scene.materials.push_back(material);
    }
}

void read_bodies(const Value& document, ReadContext& context, Scene& scene) {
    for (BlockReader& block : list(document, context, "body")) {
        BodySpec body;
        body.name = block.text("name").value_or(fmt::format("body{}", scene.bodies.size() + 1));
        set(body.material, block.text("material"));
        body.shape = Shape<2>{Box<2>{Vec<2>::Zero(), Vec<2>::Zero()}};
        if (const auto form = block.one_of({"box", "disc", "ring", "polygon", "difference"}, "shape"))
            set(body.shape, read_shape(block, *form));
        set(body.spacing, block.quantity("spacing"));
        if (auto lattice = block.table("lattice")) {
            set(body.lattice.angle, lattice->quantity("angle"));
            set(body.lattice.jitter, lattice->quantity("jitter"));
            set(body.lattice.seed, seed_of(*lattice));
        }
        set(body.bonded_to, block.names("bonded_to"));
        if (const auto velocity = block.vector("velocity", false))
            for (int axis = 0; axis < 2; ++axis) body.velocity[axis] = *velocity->at(axis);
        set(body.spin, block.quantity("spin"));
        scene.bodies.push_back(body);
    }
}

/// The index of the body that `body = ` names; -1 where the key is absent or wrong.
int body_index(BlockReader& block, const Scene& scene) {
    const auto name = block.text("body");
    if (!name) return -1;
    std::vector<std::string> known;
    for (const BodySpec& body : scene.bodies) {
        if (body.name == *name) return static_cast<int>(known.size());
        known.push_back(body.name);
    }
    const auto near = nearest(*name, known);
    block.fail("body", fmt::format("no body \"{}\"", *name),
               near ? fmt::format("did you mean \"{}\"?", *near) : "known: " + list_of(known));
    return -1;
}

void read_notches(const Value& document, ReadContext& context, Scene& scene) {
    for (BlockReader& block : list(document, context, "notch")) {
        Notch<2> notch;
        notch.name = block.text("name").value_or(fmt::format("notch{}", scene.notches.size() + 1));
        if (const auto form = block.one_of({"line", "polyline"}, "path")) {
            set(notch.points, block.points(*form));
            const std::size_t count = notch.points.size();
            if (context.problems.fine(block.path(*form)) && (count < 2 || (*form == "line" && count > 2)))
                block.fail(*form, fmt::format("[[notch]] {} needs {}; found {}", *form,
                                              *form == "line" ? "two points" : "two points or more", count));
        }
        notch.body = body_index(block, scene);
        scene.notches.push_back(notch);
    }
}

/// The particles that a [[fix]] or [[load]] names by where, body or both.
std::optional<Selection> read_selection(BlockReader& block, const Scene& scene) {
    if (!block.has("where") && !block.has("body")) return {};
    Selection selection;
    set(selection, block.condition("where"));
    selection.body = body_index(block, scene);
    return selection;
}

void read_fixes(const Value& document, ReadContext& context, Scene& scene) {
    for (BlockReader& block : list(document, context, "fix")) {
        FixSpec fix;
        fix.name = block.text("name").value_or(fmt::format("fix{}", scene.fixes.size() + 1));
        const auto selection = read_selection(block, scene);
        if (!selection)
            block.fail("where", "missing key \"where\" in [[fix]]", "for example: where = \"x < 1 m\"");
        set(fix.where, selection);
        if (const auto axes = block.choices("hold"))
            for (std::size_t i = 0; i < axes->size(); ++i) {
                if (axes->at(i) == "z")
                    block.fail(fmt::format("hold/{}", i), "[[fix]] hold: a plane model has no \"z\"");
                fix.axes[axes->at(i)[0] - 'x'] = true;
            }
        scene.fixes.push_back(fix);
    }
}

void read_value(BlockReader& block, LoadSpec& load) {
    const auto kind = block.one_of({"force", "pressure", "displacement", "velocity"}, "value");
    if (!kind) return;
    if (*kind == "pressure") {
        load.kind = Load::Kind::pressure;
        set(load.value[0], block.field("pressure", true));
        return;
    }
    load.kind = *kind == "force"          ? Load::Kind::force
                : *kind == "displacement" ? Load::Kind::displacement
                                          : Load::Kind::velocity;
    const auto value = block.vector(*kind, true, load.kind != Load::Kind::force);
    for (int axis = 0; value && axis < 2; ++axis) {
        set(load.value[axis], value->at(axis));
        load.driven[axis] = load.kind != Load::Kind::force && value->at(axis).has_value();
    }
    if (load.kind != Load::Kind::force && value && !load.driven[0] && !load.driven[1])
        block.fail(*kind, fmt::format("[[load]] {}: both directions are free", *kind), "then it is no load");
}

void read_loads(const Value& document, ReadContext& context, Scene& scene) {
    for (BlockReader& block : list(document, context, "load")) {
        LoadSpec load;
        load.name = block.text("name").value_or(fmt::format("load{}", scene.loads.size() + 1));
        load.face = block.choice("face");
        if (block.has("face") && block.has("where"))
            block.fail("face", "[[load]] has both where and face", "keep one of them");
        if (block.has("face")) {
            load.face_body = block.has("body") ? body_index(block, scene) : scene.bodies.size() == 1 ? 0 : -1;
            if (!block.has("body") && scene.bodies.size() > 1)
                block.fail("face", "[[load]] face: of which body?",
                           fmt::format("add body = \"{}\"", scene.bodies.front().name));
        } else {
            load.where = read_selection(block, scene);
            if (!load.where)
                block.fail("where", "missing key \"where\" in [[load]]",
                           "for example: where = \"x > 39 m\", or face = \"right\"");
        }
        if (block.has("pulse")) context.problems.silence(block.path("value"));
        read_value(block, load);
        set(load.ramp, block.quantity("ramp"));
        load.until = block.moment("until");
        set(load.primary, block.flag("primary"));
        set(load.no_fail, block.flag("no_fail"));
        scene.loads.push_back(load);
    }
}

void read_surroundings(const Value& document, ReadContext& context, Scene& scene) {
    if (auto block = single(document, context, "gravity")) {
        scene.gravity = Gravity{Vec3(0, -9.80665, 0)};
        if (const auto acceleration = block->vector("acceleration", false))
            for (int axis = 0; axis < 2; ++axis)
                scene.gravity->acceleration[axis] = (*acceleration->at(axis))(Vec3::Zero(), 0);
    }
    if (auto block = single(document, context, "damping")) {
        scene.damping.emplace();
        if (const auto kind = block->one_of({"ratio", "rate"}, "value"))
            (*kind == "ratio" ? scene.damping->damping.ratio : scene.damping->damping.rate) =
                block->quantity(*kind);
        scene.damping->until = block->moment("until");
    } else if (const Value* word = document.find("damping"); word && word->kind == Value::Kind::text) {
        scene.damping.emplace().damping.ratio = quasi_static_ratio;
        const bool breaks = std::any_of(scene.materials.begin(), scene.materials.end(),
                                        [](const Material& m) { return m.can_break(); });
        // Bonds that break while the load still rises belong to the quasi-static part; fragments fly.
        if (breaks && !scene.loads.empty() && !scene.fixes.empty())
            scene.damping->until = Moment{EventName::separation, 0};
    }
}

void read_run(const Value& document, ReadContext& context, Scene& scene) {
    auto block = single(document, context, "run");
    if (!block) {
        if (!document.find("run"))
            context.problems.add("run", "missing block [run]", "it needs at least max_time = \"10 s\"");
        return;
    }
    scene.run.until = block->moment("until");
    if (const auto max_time = block->quantity("max_time"))
        scene.run.max_time = *max_time;
    else if (!block->has("max_time") && scene.run.until && !scene.run.until->event)
        scene.run.max_time = scene.run.until->offset;
    else
        block->fail("max_time", "missing key \"max_time\" in [run]", "for example: max_time = \"60 s\"");
    scene.run.time_step = block->quantity("time_step");
    scene.run.time_step_factor = block->quantity("time_step_factor");
    if (block->choice("method") == "static") scene.run.statics.emplace();
    const auto load_steps = block->integer("load_steps");
    const auto breaking = block->choice("breaking");
    if (!scene.run.statics) {
        for (const char* key : {"load_steps", "breaking"})
            if (block->has(key) && context.problems.fine(block->path("method")))
                block->fail(key, fmt::format("[run] {} goes with method = \"static\"", key));
        return;
    }
    if (load_steps) {
        if (*load_steps >= 1 && *load_steps <= 1'000'000)
            scene.run.statics->load_steps = static_cast<int>(*load_steps);
        else
            block->fail("load_steps",
                        fmt::format("[run] load_steps needs to be from 1 to 1000000; found {}", *load_steps));
    }
    scene.run.statics->sequential = breaking != "together";
}

void read_view(const Value& document, ReadContext& context, View& view) {
    auto block = single(document, context, "view");
    if (!block) return;
    if (const auto size = block->size("size")) {
        view.width = size->at(0);
        view.height = size->at(1);
    }
    if (auto colour = block->table("colour")) {
        set(view.field, colour->choice("field"));
        if (const auto map = colour->choice("map"); map && *map != "auto") view.map = *map;
        view.range = colour->range("range", field_label(view.field).unit);
    }
    set(view.theme, block->choice("theme"));
    if (const auto background = block->choice("background")) view.transparent = *background == "transparent";
    set(view.show, block->choices("show"));
    if (const auto corners = block->points("window")) {
        if (corners->size() == 2 && (corners->at(0).array() < corners->at(1).array()).all())
            view.window = {corners->at(0).x(), corners->at(0).y(), corners->at(1).x(), corners->at(1).y()};
        else
            block->fail("window", "[view] window needs two corners, the low one first");
    }
    set(view.bonds, block->choice("bonds"));
    set(view.magnify, block->quantity("magnify"));
}

void read_movie(const Value& document, ReadContext& context, MovieSpec& movie) {
    auto block = single(document, context, "movie");
    if (!block) return;
    set(movie.duration, block->quantity("duration"));
    if (const auto fps = block->integer("fps")) {
        if (*fps < 1 || *fps > 240)
            block->fail("fps", "[movie] fps needs 1 to 240 frames per second");
        else
            movie.fps = static_cast<int>(*fps);
    }
    for (BlockReader& part : block->tables("slow")) {
        SlowSpec slow;
        set(slow.around, part.moment("around"));
        set(slow.span, part.quantity("span"));
        set(slow.rate, part.quantity("rate"));
        movie.slow.push_back(slow);
    }
    movie.hold = block->quantity("hold");
    set(movie.flash, block->quantity("flash"));
    movie.poster = block->moment("poster");
    set(movie.formats, block->choices("formats"));
    if (const auto megabytes = block->quantity("gif_limit")) movie.gif_limit = 1e6 * *megabytes;
}

void read_limits(BlockReader& block, TestLimits& limits) {
    TestLimits::each(limits, [&]<class T>(const char* key, std::optional<T>& limit) {
        std::optional<double> value;
        if constexpr (std::is_same_v<T, int>)
            set(value, block.integer(key));
        else
            value = block.quantity(key);
        if (!value) return;
        if (*value >= 0 && *value <= 1e9)
            limit = static_cast<T>(*value);
        else
            block.fail(key,
                       fmt::format("[test] tolerance {} needs to be from 0 to 1e9; found {}", key, *value));
    });
}

void read_test(const Value& document, ReadContext& context, TestSpec& test) {
    auto block = single(document, context, "test");
    if (!block) return;
    if (const auto size = block->size("size")) {
        test.width = size->at(0);
        test.height = size->at(1);
    }
    set(test.frames, block->moments("frames"));
    set(test.params, block->names("params"));
    for (std::size_t i = 0; i < test.params.size(); ++i)
        if (const std::size_t equals = test.params[i].find('='); equals == 0 || equals == std::string::npos)
            block->fail(fmt::format("params/{}", i),
                        fmt::format("[test] params: \"{}\" is not of the form name=value", test.params[i]),
                        "for example: \"spacing=2 m\"");
    if (auto limits = block->table("tolerance")) read_limits(*limits, test.tolerance);
}

}  // namespace

void read_blocks(const Value& document, ReadContext& context, Scene& scene) {
    for (const Entry& entry : document.entries) context.problems.stands_at(entry.key, entry.value.place);
    // In this order: what comes later may name what came before.
    if (auto block = single(document, context, "model")) read_model(*block, scene);
    read_materials(document, context, scene);
    read_bodies(document, context, scene);
    read_notches(document, context, scene);
    read_fixes(document, context, scene);
    read_loads(document, context, scene);
    read_surroundings(document, context, scene);
    read_run(document, context, scene);
    read_view(document, context, scene.view);
    read_movie(document, context, scene.movie);
    if (auto block = single(document, context, "strip")) set(scene.strip.at, block->moments("at"));
    read_test(document, context, scene.test);
    single(document, context, "contact");
    list(document, context, "rigid");
    for (const KeyBlock& block : scene_blocks()) {
        if (!block.required || block.form == KeyBlock::Form::single) continue;  // [run] is missed above
        const Value* value = document.find(block.name);
        if (!value || (value->items.empty() && value->entries.empty()))
            context.problems.add(block.name, "missing block " + block.title,
                                 "`hibi new` writes a scene to start from");
    }
}

}  // namespace hibi
