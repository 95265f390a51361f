#include "pictures/key_frames.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/units.hpp"
#include "pictures/run_extents.hpp"

namespace hibi {

namespace {

std::string words(const Moment& moment) {
    std::string text = moment.event ? to_string(*moment.event) : "";
    std::ranges::replace(text, '_', ' ');
    if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    if (moment.event && moment.offset != 0)
        text += fmt::format(" {} {}", moment.offset < 0 ? "−" : "+",
                            format_si(std::abs(moment.offset), "s", 3, true));
    return text;
}

/// Unit of the symbols for a text of 1: smaller than in a film, where it is 1/12, since pictures are small
/// here.
constexpr double symbol_share = 1.0 / 20;
/// Part of the height that an arrow may take: a flat body has one above and one below.
constexpr double arrow_share = 0.2;

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// As high as the window of the run wants a picture of this width; neither a ribbon nor a tower.
int height_for(const View& view, const RunReader& run, int width, double most) {
    std::array<double, 4> box = view.window.value_or(body_window(run, view));
    const double ratio = (box[3] - box[1]) / (box[2] - box[0]);
    // Room for symbols at all sides.
    const double room = 0.12 * width;
    const double height = std::clamp(ratio, 0.3, most) * (width - room) + room;
    return 2 * static_cast<int>(height / 2);
}

DrawingStyle still_style(const Scene& scene, const RunReader& run, const std::string& theme, int width,
                         double text, double most_height) {
    DrawingStyle style = film_style(scene, run);
    style.view.theme = theme;
    style.view.transparent = false;  // the sheet around it has a background
    style.view.show = {"supports", "loads"};
    style.view.width = 2 * (width / 2);
    style.view.height = height_for(style.view, run, width, most_height);
    style.view.stroke = 1;
    const double longest = arrow_share * style.view.height / symbol_reach(Symbol::Kind::arrow, style.view);
    style.view.stroke = std::min(symbol_share * text / symbol_unit(style.view), longest);
    return style;
}

/// From the first to the last break (s); nothing where there is none.
std::optional<std::array<double, 2>> breaking_times(const RunReader& run) {
    std::optional<std::array<double, 2>> range;
    for (const double time : run.broken_at()) {
        if (!std::isfinite(time)) continue;
        range = range ? std::array{std::min((*range)[0], time), std::max((*range)[1], time)}
                      : std::array{time, time};
    }
    return range;
}

DrawingStyle history_style(const Scene& scene, const RunReader& run, const std::string& theme, int width,
                           double text) {
    Scene unloaded = scene;
    unloaded.view.magnify = 0;
    // Alone on its line, and so no higher than a page likes.
    DrawingStyle style = still_style(unloaded, run, theme, width, text, 0.7);
    style.history = true;
    style.view.map = theme == "dark" ? "viridis_on_dark" : "viridis_on_light";
    style.range = breaking_times(run).value_or(std::array{0.0, 1.0});
    if (!(style.range[0] < style.range[1])) style.range[1] = style.range[0] + 1;
    return style;
}

/// An event knows its load; between the rows of the history a ramp's end would be cut.
double load_of(const RunReader& run, double time) {
    const Events& events = run.summary().events;
    for (const auto& event : {events.first_break, events.peak_load, events.separation})
        if (event && event->time == time) return event->load;
    return load_at(run.history(), time);
}

}  // namespace

std::vector<KeyMoment> key_moments(const Scene& scene, const RunReader& run) {
    std::vector<KeyMoment> moments;
    const double begin = run.states().front().time, end = run.states().back().time;
    for (const Moment& wanted : scene.strip.at) {
        const Events& events = run.summary().events;
        const std::optional<double> time = events.time_of(wanted);
        if (!time || *time < begin || *time > end) continue;
        if (wanted.event == EventName::peak_load && !events.first_break)
            continue;  // as large as the scene made it
        const std::string label = words(wanted);
        const auto same = std::ranges::find(moments, *time, &KeyMoment::time);
        if (same == moments.end())
            moments.push_back({*time, label, ""});
        else if (!label.empty())
            same->label +=
                same->label.empty() ? label : ", " + std::string(1, lower(label[0])) + label.substr(1);
    }
    std::ranges::sort(moments, {}, &KeyMoment::time);
    for (KeyMoment& m : moments) {
        m.detail = "t = " + format_si(m.time, "s", 3, m.time == 0);
        if (!run.topology().loads.empty())
            m.detail += ", " + format_si(load_of(run, m.time), "N", 3, m.time == 0);
    }
    return moments;
}

StillDrawing::StillDrawing(const Scene& scene, const RunReader& run, const std::string& theme, int width,
                           double text, const RendererOptions& options)
    : StillDrawing(scene, run, still_style(scene, run, theme, width, text, 1.6), options) {}

StillDrawing::StillDrawing(const Scene& scene, const RunReader& run, DrawingStyle style,
                           const RendererOptions& options)
    : width_(style.view.width), height_(style.view.height), drawing_(scene, run, std::move(style), options) {}

Image StillDrawing::draw(double time) {
    Image image(width_, height_);
    drawing_.draw_at(time, image);
    return image;
}

HistoryDrawing::HistoryDrawing(const Scene& scene, const RunReader& run, const std::string& theme, int width,
                               double text, const RendererOptions& options)
    : HistoryDrawing(scene, run, history_style(scene, run, theme, width, text), options) {}

HistoryDrawing::HistoryDrawing(const Scene& scene, const RunReader& run, DrawingStyle style,
                               const RendererOptions& options)
    : end_(run.states().back().time),
      width_(style.view.width),
      height_(style.view.height),
      colours_(breaking_times(run) ? std::optional(ColourBar{"Time of breaking", "s", style.range[0],
                                                             style.range[1], *style.view.map})
                                   : std::nullopt),
      drawing_(scene, run, std::move(style), options) {}

Image HistoryDrawing::draw() {
    Image image(width_, height_);
    drawing_.draw_at(end_, image);
    return image;
}

}  // namespace hibi
