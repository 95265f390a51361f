#include "pictures/run_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/units.hpp"
#include "image/background.hpp"
#include "pictures/drawing_origin.hpp"
#include "pictures/run_extents.hpp"

namespace hibi {

namespace {

/// A column of the history at any moment, straight lines between its rows.
template <class Value>
double at_time(const History& history, double time, Value&& value) {
    const std::vector<HistoryRow>& rows = history.rows;
    if (rows.empty()) return 0;
    const auto after = std::ranges::upper_bound(rows, time, {}, &HistoryRow::time);
    if (after == rows.begin()) return value(rows.front());
    if (after == rows.end()) return value(rows.back());
    const HistoryRow &a = *(after - 1), &b = *after;
    return value(a) + (time - a.time) / (b.time - a.time) * (value(b) - value(a));
}

/// Driven particles: what they are made to do grows steadily, while their reaction trembles.
double load_quantity(const Topology& topology, int load, const HistoryRow& row) {
    const bool by_force = topology.loads[load].kind == "force" || topology.loads[load].kind == "pressure";
    const std::vector<double>& values = by_force ? row.loads : row.displacements;
    return load < static_cast<int>(values.size()) ? values[load] : 0;
}

/// A signed field is shown by the map made for it, unless a range of the user's may have its zero off the
/// middle.
View shown_view(const Scene& scene) {
    View view = scene.view;
    if (!view.map) view.map = !view.range && field_label(view.field).is_signed ? "diverging" : "inferno";
    return view;
}

}  // namespace

double load_at(const History& history, double time) {
    return at_time(history, time, [](const HistoryRow& row) { return row.load; });
}

std::string describe(const Scene& scene, const Topology& topology) {
    std::string text =
        fmt::format("{} particles · {} bonds", topology.reference_position.size(), topology.first.size());
    for (const Material& m : scene.materials)
        text += fmt::format(" · {}: E = {}, ν = {:g}", m.name, format_si(m.youngs_modulus, "Pa", 3, true),
                            m.poissons_ratio);
    text += scene.assumption == Assumption::plane_stress ? " · plane stress" : " · plane strain";
    if (scene.view.magnify != 1) text += fmt::format(" · displacements drawn × {:g}", scene.view.magnify);
    return text;
}

DrawingStyle film_style(const Scene& scene, const RunReader& run) {
    DrawingStyle style{.view = shown_view(scene),
                       .title = scene.title,
                       .plan = plan_film(scene.movie, run.summary().events, run.broken_at(),
                                         run.states().front().time, run.states().back().time),
                       .origin = drawing_origin(run.topology(), scene.view.window)};
    style.range =
        scene.view.range.value_or(colour_range(run, scene.view.field, *style.view.map == "diverging"));
    return style;
}

RunDrawing::RunDrawing(const Scene& scene, const RunReader& run, DrawingStyle style,
                       const RendererOptions& options)
    : run_(run),
      topology_(topology_from(style.origin, run)),
      profile_(options.profile),
      style_(std::move(style)),
      until_(run.summary().events.separation ? run.summary().events.separation->time
                                             : std::numeric_limits<double>::infinity()),
      source_(run, style_.view, style_.range, style_.origin, options.profile),
      overlay_(style_.view, content(scene)),
      renderer_(style_.view, topology_, options),
      anchors_(find_symbol_anchors(topology_, style_.view.shows("supports"), style_.view.shows("loads"))),
      notches_(find_notches(topology_)),
      unit_(symbol_unit(style_.view)) {
    for (int k = 0; k < static_cast<int>(run.topology().loads.size()); ++k) {
        double largest = 0;
        for (const HistoryRow& row : run.history().rows)
            if (row.time <= until_)
                largest = std::max(largest, std::abs(load_quantity(run.topology(), k, row)));
        largest_.push_back(largest);
    }
    camera_ = camera();
}

int RunDrawing::draw(int frame, Image& image, std::optional<int> next) {
    OverlayFrame over{.speed = plan().speed(frame)};
    if (const auto label = style_.event_labels ? plan().label(frame) : std::nullopt) {
        over.event = label->text;
        over.event_strength = label->strength;
    }
    return draw(plan().time[frame], plan().film_time(frame), std::move(over), image,
                next ? std::optional(plan().time[*next]) : std::nullopt);
}

int RunDrawing::draw_at(double time, Image& image) {
    return draw(time, plan().map.film(time), {}, image, {});
}

int RunDrawing::draw(double time, double film_time, OverlayFrame over, Image& image,
                     std::optional<double> next) {
    Picture2& picture = source_.at(time, renderer_.shows_bonds(camera_));
    if (next) source_.expect(*next);
    picture.camera = camera_;
    const std::vector<double>& broken_at = run_.broken_at();
    if (style_.history) {
        picture.value.clear();
        const double span = style_.range[1] - style_.range[0];
        for (const int bond : picture.broken)
            picture.history.push_back(static_cast<float>((broken_at[bond] - style_.range[0]) / span));
    } else {
        for (std::size_t k = 0; k < picture.broken.size(); ++k)
            picture.freshness[k] =
                static_cast<float>(plan().freshness(film_time, broken_at[picture.broken[k]]));
    }

    over.time = time;
    over.load = load_at(run_.history(), time);
    over.broken = static_cast<int>(picture.broken.size());
    over.pixels_per_metre = camera_.scale;
    place_symbols(time, over);
    draw_on_background(style_.view, image, [&](const Rgb& background, Image& on) {
        renderer_.draw(picture, background, on);
        const TimedStage timed(profile_, "overlay");
        overlay_.draw(on, over);
    });
    return over.broken;
}

void RunDrawing::place_symbols(double time, OverlayFrame& over) const {
    const TimedStage timed(profile_, "place symbols");
    for (const SymbolAnchor& anchor : anchors_) {
        const double size = anchor.load < 0 ? 1 : load_size(anchor.load, time);
        over.symbols.push_back(place_symbol(anchor, source_.x(), source_.y(), camera_, size, unit_));
    }
    for (const NotchLine& notch : notches_)
        over.symbols.push_back(place_notch(notch, topology_, source_.x(), source_.y(), camera_));
}

/// The window of the user's, or the body in all states that count, with its symbols at some of them.
Camera2 RunDrawing::camera() {
    const PixelRect plot = overlay_.plot();
    const View& view = style_.view;
    if (view.window) {
        const std::array<double, 4> w = counted_from(style_.origin, *view.window);
        return Camera2::fit(w[0], w[1], w[2], w[3], plot);
    }
    std::vector<Reserved> reserved;
    const int last = last_counting_state(run_);
    const std::vector<double>& loose = detached_at(run_);
    std::vector<double> x(loose.size()), y(loose.size());  // of the anchors' particles
    constexpr int samples = 16;
    for (int k = 0; k <= samples && !anchors_.empty(); ++k) {
        const int state = last * k / samples;
        const double time = run_.states()[state].time;
        for (const auto& [i, u] : anchor_displacements(run_, state)) {
            x[i] = topology_.reference_position[i].x() + view.magnify * u.x();
            y[i] = topology_.reference_position[i].y() + view.magnify * u.y();
        }
        for (const SymbolAnchor& anchor : anchors_) {
            if (std::ranges::any_of(anchor.particles, [&](int i) { return loose[i] <= time; })) continue;
            const double size = anchor.load < 0 ? 1 : load_size(anchor.load, time);
            for (const Reserved& r : reserve(anchor, x, y, size, view)) reserved.push_back(r);
        }
    }
    return camera_for(style_.window.value_or(body_window(run_, view, style_.origin)), reserved, plot);
}

double RunDrawing::load_size(int load, double time) const {
    if (largest_[load] <= 0) return 0;
    const auto quantity = [&](const HistoryRow& row) { return load_quantity(run_.topology(), load, row); };
    return at_time(run_.history(), time, quantity) / largest_[load];
}

OverlayContent RunDrawing::content(const Scene& scene) const {
    const FieldLabel field = field_label(style_.view.field);
    OverlayContent c;
    c.title = style_.title;
    c.subtitle = describe(scene, run_.topology());
    c.colour_bar = {field.title, field.unit, style_.range[0], style_.range[1], *style_.view.map};
    if (style_.history)
        c.colour_bar.title = std::string("Time of breaking"), c.colour_bar.unit = std::string("s");
    c.has_breaks = std::ranges::any_of(scene.materials, &Material::can_break);
    c.time_end = run_.states().back().time;
    c.time_resolution = plan().smallest_step();
    if (run_.topology().loads.empty()) return c;
    c.load_title = std::string("Load");  // (g++ 12 warns wrongly of an assigned literal here)
    c.load_unit = std::string("N");
    c.curve = {.x_title = "Displacement", .x_unit = "m", .y_title = "Load", .y_unit = "N"};
    for (const HistoryRow& row : run_.history().rows) {
        if (row.time > until_) break;
        c.load_max = std::max(c.load_max, std::abs(row.load));
        c.curve.time.push_back(row.time);
        c.curve.x.push_back(row.displacement);
        c.curve.y.push_back(row.load);
        if (c.has_breaks) c.curve.broken.push_back(row.broken);
    }
    return c;
}

}  // namespace hibi
