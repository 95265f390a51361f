#include "picture_tests/reference.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/units.hpp"
#include "pictures/run_drawing.hpp"
#include "record/files.hpp"
#include "record/tables.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

std::string file_words(const Moment& moment) {
    if (!moment.event) return fmt::format("at_{:g}s", moment.offset);
    return to_string(*moment.event) + (moment.offset == 0 ? "" : fmt::format("{:+g}s", moment.offset));
}

Json event_json(const std::optional<Event>& event) {
    return event ? Json{{"time", event->time}, {"load", event->load}} : Json(nullptr);
}

std::optional<Event> event_from(const Json& json) {
    if (json.is_null()) return {};
    return Event{.time = json.at("time"), .load = json.at("load")};
}

Json to_json(const Reference& r) {
    Json frames = Json::array(), breaks = Json::array();
    for (const ReferenceFrame& f : r.frames)
        frames.push_back({{"moment", f.moment},
                          {"file", f.file},
                          {"time", f.time},
                          {"sha256", f.sha256},
                          {"step", f.step},
                          {"displacement", f.displacement}});
    for (const Reference::Break& b : r.breaks) breaks.push_back({b.first, b.second, b.step});
    return {{"key", {{"renderer", r.key.renderer}, {"cpu", r.key.cpu}}},
            {"version", r.version},
            {"scene_hash", r.scene_hash},
            {"frames", frames},
            {"physics",
             {{"particles", r.particles},
              {"bonds", r.bonds},
              {"broken", r.broken},
              {"spacing", r.spacing},
              {"time_step", r.time_step},
              {"end_time", r.end_time},
              {"first_break", event_json(r.events.first_break)},
              {"peak_load", event_json(r.events.peak_load)},
              {"separation", event_json(r.events.separation)},
              {"breaks", breaks}}}};
}

Reference from_json(const Json& json) {
    Reference r;
    json.at("key").at("renderer").get_to(r.key.renderer);
    json.at("key").at("cpu").get_to(r.key.cpu);
    json.at("version").get_to(r.version);
    json.at("scene_hash").get_to(r.scene_hash);
    for (const Json& f : json.at("frames")) {
        r.frames.push_back(
            {f.at("moment"), f.at("file"), f.at("time"), f.at("sha256"), f.at("step"), f.at("displacement")});
        // It is joined to a folder, and must not lead out of it.
        if (fs::path(r.frames.back().file).filename() != r.frames.back().file)
            throw std::invalid_argument("file names a folder");
    }
    const Json& physics = json.at("physics");
    physics.at("particles").get_to(r.particles);
    physics.at("bonds").get_to(r.bonds);
    physics.at("broken").get_to(r.broken);
    physics.at("spacing").get_to(r.spacing);
    physics.at("time_step").get_to(r.time_step);
    physics.at("end_time").get_to(r.end_time);
    r.events.first_break = event_from(physics.at("first_break"));
    r.events.peak_load = event_from(physics.at("peak_load"));
    r.events.separation = event_from(physics.at("separation"));
    for (const Json& b : physics.at("breaks")) r.breaks.push_back({b.at(0), b.at(1), b.at(2)});
    return r;
}

/// Objects and arrays of numbers on one line each, so that a change is a line in a diff.
std::string text_of(const Json& json) {
    std::string text = "{\n";
    for (auto part = json.begin(); part != json.end(); ++part) {
        if (part != json.begin()) text += ",\n";
        text += fmt::format(" \"{}\": ", part.key());
        if (!part->is_array()) {
            text += part->dump();
            continue;
        }
        text += "[";
        for (std::size_t k = 0; k < part->size(); ++k) text += (k ? ",\n  " : "\n  ") + (*part)[k].dump();
        text += "]";
    }
    return text + "\n}\n";
}

double root_mean_square(const std::vector<Vec3>& displacement) {
    double sum = 0;
    for (const Vec3& u : displacement) sum += u.squaredNorm();
    return displacement.empty() ? 0 : std::sqrt(sum / static_cast<double>(displacement.size()));
}

int last_state_by(const RunReader& run, double time) {
    int last = 0;
    for (int k = 0; k < static_cast<int>(run.states().size()); ++k)
        if (run.states()[k].time <= time) last = k;
    return last;
}

Reference numbers_of(const RunReader& run) {
    const RunSummary& s = run.summary();
    Reference r;
    r.version = HIBI_VERSION;
    r.scene_hash = s.scene_hash;
    r.particles = s.particles;
    r.bonds = s.bonds;
    r.broken = s.broken;
    const std::vector<double>& spacing = run.topology().spacing;
    r.spacing = spacing.empty() ? 0 : *std::ranges::min_element(spacing);
    r.time_step = s.time_step;
    r.end_time = s.end_time;
    r.events = s.events;
    for (const Break& b : read_breaks(run.folder() / "breaks.csv")) {
        if (r.breaks.size() == Reference::most_breaks) break;
        r.breaks.push_back({b.first, b.second, s.time_step > 0 ? std::llround(b.time / s.time_step) : 0});
    }
    return r;
}

/// The earliest break at another step, or in one of the two only, as far as both lists reach.
std::optional<BondChange> first_change(const Reference& a, const Reference& b, int tolerated_steps) {
    constexpr double never = std::numeric_limits<double>::infinity();
    const auto end_of = [](const Reference& r) {
        return r.breaks.size() < Reference::most_breaks ? std::numeric_limits<std::int64_t>::max()
                                                        : r.breaks.back().step;
    };
    const std::int64_t end = std::min(end_of(a), end_of(b));
    std::map<std::pair<int, int>, std::array<double, 2>> steps;
    for (int side = 0; side < 2; ++side)
        for (const Reference::Break& x : (side == 0 ? a : b).breaks)
            steps.try_emplace({x.first, x.second}, std::array{never, never}).first->second[side] =
                static_cast<double>(x.step);
    std::optional<BondChange> first;
    for (const auto& [bond, at] : steps) {
        if (std::abs(at[0] - at[1]) <= tolerated_steps || at[0] == at[1]) continue;
        // Of the last moment of a list that was cut, some breaks are missing.
        if (std::min(at[0], at[1]) >= static_cast<double>(end)) continue;
        BondChange change{0, bond.first, bond.second, at[0] * a.time_step, at[1] * a.time_step};
        // In a list that was cut it may have broken later.
        if (std::isfinite(at[0]) && std::isfinite(at[1])) change.steps = std::llround(at[1] - at[0]);
        if (!first || change.time() < first->time()) first = change;
    }
    return first;
}

}  // namespace

std::string cpu_class() {
    std::string name;
#if defined(__x86_64__)
    __builtin_cpu_init();
    name = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") ? "x86-64-v4"
           : __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")       ? "x86-64-v3"
           : __builtin_cpu_supports("sse4.2")                                      ? "x86-64-v2"
                                                                                   : "x86-64";
#else
    utsname machine{};
    uname(&machine);
    name = machine.machine;
#endif
    if (const char* caps = std::getenv("GALLIUM_OVERRIDE_CPU_CAPS"))
        name += fmt::format(" drawing as {}", caps);
    return name;
}

PictureKey key_of(const std::string& renderer) {
    return {renderer.substr(0, renderer.rfind(", ")), cpu_class()};
}

fs::path reference_folder(const fs::path& scene) { return scene.parent_path() / "references" / scene.stem(); }

std::optional<Reference> read_reference(const fs::path& folder) {
    const fs::path file = folder / "references.json";
    if (!fs::exists(file)) return {};
    try {
        return from_json(Json::parse(read_file(file)));
    } catch (const std::exception& error) {
        throw std::invalid_argument(
            fmt::format("{}: not the references of a test: {}; restore it, or write it "
                        "anew with hibi test --update all",
                        file.string(), error.what()));
    }
}

void write_reference(const fs::path& folder, const Reference& reference) {
    fs::create_directories(folder);
    write_file(folder / "references.json", text_of(to_json(reference)));
}

const Image& DrawnTest::image_of(const std::string& file) const {
    for (std::size_t k = 0; k < images.size(); ++k)
        if (reference.frames[k].file == file && images[k].width > 0) return images[k];
    throw std::out_of_range(file);
}

DrawnTest draw_test(const Scene& scene, const RunReader& run, const RendererOptions& options) {
    Scene small = scene;
    small.view.width = scene.test.width;
    small.view.height = scene.test.height;
    RunDrawing drawing(small, run, film_style(small, run), options);
    DrawnTest test{numbers_of(run), {}};
    test.reference.key = key_of(drawing.renderer());
    const double begin = run.states().front().time, end = run.states().back().time;
    std::vector<std::pair<double, std::string>> moments;
    for (const Moment& moment : scene.test.frames)
        if (const std::optional<double> time = run.summary().events.time_of(moment);
            time && *time >= begin && *time <= end)
            moments.emplace_back(*time, file_words(moment));
    std::ranges::stable_sort(moments, {}, &std::pair<double, std::string>::first);
    for (const auto& [time, name] : moments) {
        std::vector<ReferenceFrame>& frames = test.reference.frames;
        if (!frames.empty() && frames.back().time == time) {
            frames.push_back(frames.back());
            frames.back().moment = name;
            test.images.emplace_back();
            continue;
        }
        Image image(small.view.width, small.view.height);
        drawing.draw_at(time, image);
        const int state = last_state_by(run, time);
        frames.push_back({name, name + ".png", time, pixel_hash(image), run.states()[state].step,
                          root_mean_square(run.read(state).displacement)});
        test.images.push_back(std::move(image));
    }
    return test;
}

std::string physics_change(const Reference& a, const Reference& b, const RunTolerance& tolerance) {
    if (a.particles != b.particles || a.bonds != b.bonds)
        return fmt::format("another body: {} particles and {} bonds, not {} and {}", b.particles, b.bonds,
                           a.particles, a.bonds);
    if (std::abs(a.time_step - b.time_step) > 1e-9 * a.time_step)
        return fmt::format("another time step: {}, not {}", format_si(b.time_step, "s", 4),
                           format_si(a.time_step, "s", 4));
    double scale = 0;
    for (const auto& event : {a.events.first_break, a.events.peak_load, a.events.separation})
        if (event) scale = std::max(scale, std::abs(event->load));
    std::string loads;
    const auto load = [&](const char* name, const std::optional<Event>& x, const std::optional<Event>& y) {
        const CurveDifference::Pair pair{x ? std::optional(x->load) : std::nullopt,
                                         y ? std::optional(y->load) : std::nullopt};
        if (!pair.same(tolerance.load * scale)) loads += fmt::format("; {} {}", name, relative_change(pair));
    };
    load("load at first break", a.events.first_break, b.events.first_break);
    load("peak load", a.events.peak_load, b.events.peak_load);

    double first = std::numeric_limits<double>::infinity();
    std::string what;
    const auto consider = [&](double time, const std::string& words) {
        if (time < first) first = time, what = words;
    };
    if (const auto bond = first_change(a, b, tolerance.break_steps)) consider(bond->time(), describe(*bond));
    for (const ReferenceFrame& x : a.frames)
        for (const ReferenceFrame& y : b.frames)
            if (x.moment == y.moment && x.step == y.step &&
                !(std::abs(x.displacement - y.displacement) <= tolerance.position * a.spacing))
                consider(x.time,
                         fmt::format("particles moved by {} on average, not {}",
                                     format_si(y.displacement, "m", 4), format_si(x.displacement, "m", 4)));
    if (a.broken != b.broken)
        consider(std::min(a.end_time, b.end_time),
                 fmt::format("{} broken bonds, not {}", b.broken, a.broken));
    if (std::abs(a.end_time - b.end_time) > (tolerance.break_steps + 0.5) * a.time_step)
        consider(std::min(a.end_time, b.end_time),
                 fmt::format("it ends at {}, not at {}", format_si(b.end_time, "s", 4),
                             format_si(a.end_time, "s", 4)));
    if (!what.empty())
        return fmt::format("physics changed first at t = {}: {}{}", format_si(first, "s", 4), what, loads);
    return loads.empty() ? "" : "physics changed: " + loads.substr(2);
}

}  // namespace hibi
