#include <fmt/format.h>

#include "scene/read.hpp"

namespace hibi {

namespace {

/// A TOML basic string.
std::string quote(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += std::string("\\") + c;
        else if (c == '\n')
            result += "\\n";
        else if (c == '\r')
            result += "\\r";
        else if (c == '\t')
            result += "\\t";
        else
            result += c;
    }
    return result + "\"";
}

std::string bare_key(const std::string& name) {
    const bool bare =
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") ==
        std::string::npos;
    return bare && !name.empty() ? name : quote(name);
}

// Shortest text that reads back as the same double.
std::string number(double value) { return fmt::format("{}", value); }
std::string number(const Field& field) {
    return field.is_constant() ? number(field(Vec3::Zero(), 0)) : quote(field.text());
}
std::string point(const Vec<2>& p) { return fmt::format("[{}, {}]", p.x(), p.y()); }

std::string points(const std::vector<Vec<2>>& list) {
    std::string text;
    for (const Vec<2>& p : list) text += (text.empty() ? "" : ", ") + point(p);
    return "[" + text + "]";
}

std::string names(const std::vector<std::string>& list) {
    std::string text;
    for (const std::string& name : list) text += (text.empty() ? "" : ", ") + quote(name);
    return "[" + text + "]";
}

std::string moment(const Moment& m) {
    if (!m.event) return number(m.offset);
    if (m.offset == 0) return quote(to_string(*m.event));
    return quote(
        fmt::format("{} {} {} s", to_string(*m.event), m.offset < 0 ? "-" : "+", std::abs(m.offset)));
}

std::string moments(const std::vector<Moment>& list) {
    std::string text;
    for (const Moment& m : list) text += (text.empty() ? "" : ", ") + moment(m);
    return "[" + text + "]";
}

struct ShapeWriter {
    std::string operator()(const Box<2>& s) const { return "box = " + points({s.low, s.high}); }
    std::string operator()(const Disc<2>& s) const {
        return fmt::format("disc = {{ centre = {}, radius = {} }}", point(s.centre), s.radius);
    }
    std::string operator()(const Ring<2>& s) const {
        return fmt::format("ring = {{ centre = {}, inner = {}, outer = {} }}", point(s.centre), s.inner,
                           s.outer);
    }
    std::string operator()(const Polygon& s) const { return "polygon = " + points(s.corners); }
    std::string operator()(const Difference<2>& s) const {
        std::string text;
        for (const Shape<2>& part : s.parts)
            text += (text.empty() ? "{ " : ", { ") + std::visit(*this, part.form) + " }";
        return "difference = [" + text + "]";
    }
};

class Writer {
 public:
    void block(const std::string& title) { text += fmt::format("\n{}\n", title); }
    void line(const std::string& key, const std::string& value) {
        text += fmt::format("{} = {}\n", key, value);
    }
    void line(const std::string& key, double value) { line(key, number(value)); }
    void line(const std::string& key, bool value) { line(key, std::string(value ? "true" : "false")); }
    template <class T>
    void line(const std::string& key, const std::optional<T>& value) {
        if (value) line(key, *value);
    }
    void line(const std::string& key, const std::optional<Moment>& value) {
        if (value) line(key, moment(*value));
    }
    std::string text;
};

void write_selection(Writer& out, const Selection& selection, const Scene& scene) {
    if (!selection.text.empty()) out.line("where", quote(selection.text));
    if (selection.body >= 0) out.line("body", quote(scene.bodies[selection.body].name));
}

void write_materials(Writer& out, const Scene& scene) {
    for (const Material& m : scene.materials) {
        out.block(fmt::format("[material.{}]", bare_key(m.name)));
        out.line("density", m.density);
        out.line("youngs_modulus", m.youngs_modulus);
        out.line("poissons_ratio", m.poissons_ratio);
        out.line("break_strain", m.break_strain);
        out.line("fracture_energy", m.fracture_energy);
        out.line("tension_only", m.tension_only);
        if (m.weibull)
            out.line("weibull",
                     fmt::format("{{ shape = {}, seed = {} }}", m.weibull->shape, m.weibull->seed));
    }
}

void write_bodies(Writer& out, const Scene& scene) {
    for (const BodySpec& body : scene.bodies) {
        out.block("[[body]]");
        out.line("name", quote(body.name));
        out.line("material", quote(body.material));
        out.text += std::visit(ShapeWriter{}, body.shape.form) + "\n";
        out.line("spacing", number(body.spacing));
        if (body.lattice != Lattice{})
            out.line("lattice", fmt::format("{{ angle = {}, jitter = {}, seed = {} }}", body.lattice.angle,
                                            body.lattice.jitter, body.lattice.seed));
        out.line("bonded_to", names(body.bonded_to));
        out.line("velocity", fmt::format("[{}, {}]", number(body.velocity[0]), number(body.velocity[1])));
        out.line("spin", body.spin);
    }
    for (const Notch<2>& notch : scene.notches) {
        out.block("[[notch]]");
        out.line("name", quote(notch.name));
        out.line("polyline", points(notch.points));
        if (notch.body >= 0) out.line("body", quote(scene.bodies[notch.body].name));
    }
}

void write_supports_and_loads(Writer& out, const Scene& scene) {
    for (const FixSpec& fix : scene.fixes) {
        out.block("[[fix]]");
        out.line("name", quote(fix.name));
        write_selection(out, fix.where, scene);
        std::vector<std::string> axes;
        for (int axis = 0; axis < 2; ++axis)
            if (fix.axes[axis]) axes.emplace_back(1, static_cast<char>('x' + axis));
        out.line("hold", names(axes));
    }
    for (const LoadSpec& load : scene.loads) {
        out.block("[[load]]");
        out.line("name", quote(load.name));
        if (load.where) write_selection(out, *load.where, scene);
        if (load.face) {
            out.line("face", quote(*load.face));
            out.line("body", quote(scene.bodies[load.face_body].name));
        }
        static constexpr const char* keys[] = {"force", "pressure", "displacement", "velocity"};
        const std::string key = keys[static_cast<int>(load.kind)];
        const auto component = [&](int axis) {
            return load.kind == Load::Kind::force || load.driven[axis] ? number(load.value[axis])
                                                                       : quote("free");
        };
        out.line(key, load.kind == Load::Kind::pressure
                          ? number(load.value[0])
                          : fmt::format("[{}, {}]", component(0), component(1)));
        out.line("ramp", load.ramp);
        out.line("until", load.until);
        out.line("primary", load.primary);
        out.line("no_fail", load.no_fail);
    }
    if (scene.gravity) {
        out.block("[gravity]");
        out.line("acceleration", point(scene.gravity->acceleration.head<2>()));
    }
    if (scene.damping) {
        out.block("[damping]");
        out.line("ratio", scene.damping->damping.ratio);
        out.line("rate", scene.damping->damping.rate);
        out.line("until", scene.damping->until);
    }
}

void write_pictures(Writer& out, const View& view, const MovieSpec& movie, const StripSpec& strip) {
    out.block("[view]");
    out.line("size", fmt::format("[{}, {}]", view.width, view.height));
    out.line("colour", fmt::format("{{ field = {}, map = {}, range = {} }}", quote(view.field),
                                   quote(view.map.value_or("auto")),
                                   view.range ? fmt::format("[{}, {}]", view.range->at(0), view.range->at(1))
                                              : quote("run")));
    out.line("theme", quote(view.theme));
    out.line("background", quote(view.transparent ? "transparent" : "theme"));
    out.line("show", names(view.show));
    if (view.window)
        out.line("window", points({{view.window->at(0), view.window->at(1)},
                                   {view.window->at(2), view.window->at(3)}}));
    out.line("bonds", quote(view.bonds));
    out.line("magnify", view.magnify);

    out.block("[movie]");
    out.line("duration", movie.duration);
    out.line("fps", number(movie.fps));
    std::string slow;
    for (const SlowSpec& s : movie.slow)
        slow += fmt::format("{}{{ around = {}, span = {}, rate = {} }}", slow.empty() ? "" : ", ",
                            moment(s.around), s.span, s.rate);
    out.line("slow", "[" + slow + "]");
    out.line("hold", movie.hold_seconds());
    out.line("flash", movie.flash);
    out.line("poster", movie.poster);
    out.line("formats", names(movie.formats));
    out.line("gif_limit", movie.gif_limit / 1e6);

    out.block("[strip]");
    out.line("at", moments(strip.at));
}

}  // namespace

std::string write_scene(const Scene& scene) {
    Writer out;
    out.line("version", std::string("1"));
    out.line("title", quote(scene.title));
    out.line("about", quote(scene.about));

    out.block("[model]");
    out.line("dimension", number(scene.dimension));
    out.line("assumption",
             quote(scene.assumption == Assumption::plane_stress ? "plane stress" : "plane strain"));
    out.line("thickness", scene.thickness);
    out.line("influence", scene.influence);
    out.line("elasticity", quote(scene.elasticity == Elasticity::thesis ? "thesis" : "moment-matched"));

    write_materials(out, scene);
    write_bodies(out, scene);
    write_supports_and_loads(out, scene);

    out.block("[run]");
    out.line("until", scene.run.until);
    out.line("max_time", scene.run.max_time);
    out.line("method", quote(scene.run.statics ? "static" : "explicit"));
    if (scene.run.statics) {
        out.line("load_steps", fmt::format("{}", scene.run.statics->load_steps));
        out.line("breaking", quote(scene.run.statics->sequential ? "sequential" : "together"));
    }
    out.line("time_step", scene.run.time_step);
    out.line("time_step_factor", scene.run.time_step_factor);
    write_pictures(out, scene.view, scene.movie, scene.strip);
    out.block("[test]");
    out.line("size", fmt::format("[{}, {}]", scene.test.width, scene.test.height));
    out.line("frames", moments(scene.test.frames));
    out.line("params", names(scene.test.params));
    std::string limits;
    TestLimits::each(scene.test.tolerance, [&](const char* key, const auto& limit) {
        if (limit) limits += fmt::format("{}{} = {}", limits.empty() ? "" : ", ", key, *limit);
    });
    if (!limits.empty()) out.line("tolerance", "{ " + limits + " }");
    return std::move(out.text);
}

}  // namespace hibi
