#include "report/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/units.hpp"
#include "image/axis.hpp"
#include "image/chart.hpp"
#include "record/provenance.hpp"
#include "report/curves.hpp"
#include "report/html.hpp"
#include "report/page_files.hpp"

namespace hibi {

namespace {

using Json = nlohmann::ordered_json;

/// The cursor needs no more rows than a curve has pixels.
constexpr std::size_t most_rows = 1500;

/// Nothing in it can end the script element it stands in.
std::string script_safe(const Json& json) {
    std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
    for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
    return text;
}

struct NamedEvent {
    const char* name;
    const std::optional<Event>* event;
};
std::array<NamedEvent, 3> events_of(const Events& e) {
    return {{{"First break", &e.first_break}, {"Peak load", &e.peak_load}, {"Separation", &e.separation}}};
}

std::string outcome(const RunSummary& s) {
    std::string text;
    for (const auto& [name, event] : events_of(s.events)) {
        if (!*event) continue;
        std::string words = name;
        if (!text.empty())
            words = ", " + std::string(1, static_cast<char>(words[0] - 'A' + 'a')) + words.substr(1);
        text += fmt::format("{} at {}", words, format_si((*event)->time, "s"));
        if (s.events.peak_load) text += " under " + format_si((*event)->load, "N");
    }
    if (!text.empty()) text += ".";
    if (!s.events.first_break) text = text.empty() ? "No bond broke." : "No bond broke. " + text;
    return text;
}

std::string verdict(const RunSummary& s) {
    const std::string figures =
        fmt::format("The energy balance is off by {:.2g} % at most ({:.2g} % up to first break).",
                    100 * s.worst_imbalance, 100 * s.imbalance_at_first_break);
    if (s.stopped)
        return fmt::format("<p class=\"verdict bad\"><strong>The run stopped early</strong>: {}. {}</p>\n",
                           escaped(*s.stopped), figures);
    return fmt::format("<p class=\"verdict{}\"><strong>{}</strong> {}</p>\n", s.trusted ? "" : " bad",
                       s.trusted ? "The run can be trusted." : "Do not trust this run.", figures);
}

std::string results(const RunSummary& s) {
    const bool loaded = s.events.peak_load.has_value();
    std::string text =
        "<div class=\"scroll\"><table class=\"events\">\n<thead><tr><th scope=\"col\">Event</th><th "
        "scope=\"col\">Time</th>";
    if (loaded) text += "<th scope=\"col\">Load</th><th scope=\"col\">Displacement</th>";
    text += "<th scope=\"col\">Place</th></tr></thead>\n<tbody>\n";
    for (const auto& [name, event] : events_of(s.events)) {
        text += fmt::format("<tr><th scope=\"row\">{}</th>", name);
        if (!*event) {
            text += fmt::format("<td colspan=\"{}\">did not happen</td></tr>\n", loaded ? 4 : 2);
            continue;
        }
        text += fmt::format("<td>{}</td>", format_si((*event)->time, "s", 4));
        if (loaded)
            text += fmt::format("<td>{}</td><td>{}</td>", format_si((*event)->load, "N", 4),
                                format_si((*event)->displacement, "m"));
        const Vec3& at = (*event)->position;
        text += event == &s.events.first_break
                    ? fmt::format("<td>({:.4g}, {:.4g}) m</td></tr>\n", at.x(), at.y())
                    : std::string("<td></td></tr>\n");
    }
    text += "</tbody></table></div>\n<div class=\"scroll\"><table><tbody>\n";
    const auto row = [&](const std::string& name, const std::string& value) {
        text += fmt::format("<tr><th scope=\"row\">{}</th><td>{}</td></tr>\n", escaped(name), escaped(value));
    };
    row("Particles", fmt::format("{}", s.particles));
    row("Bonds", fmt::format("{}, of which {} broke", s.bonds, s.broken));
    row("Steps",
        fmt::format("{} of {}, {} in all", s.steps, format_si(s.time_step, "s"), format_si(s.end_time, "s")));
    for (const auto& [name, value] : s.parameters) row("Parameter " + name, value);
    if (const auto solve = s.seconds.find("solve"); solve != s.seconds.end())
        row("Solved in", fmt::format("{} on {} threads", format_si(solve->second, "s"), s.threads));
    return text + "</tbody></table></div>\n";
}

Json scale_json(double largest, double resolution, const std::string& unit) {
    const Scale scale = scale_for(largest, unit);
    const double step = resolution * scale.factor;
    const int decimals =
        step > 0 ? std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-6)), 0, 6) : 2;
    return {{"factor", scale.factor}, {"unit", scale.unit}, {"decimals", decimals}};
}

/// What the script needs: frames, history, and where the curves are.
Json run_json(const PageContent& c, const std::vector<Chart>& charts, const std::vector<ChartPlace>& places) {
    const std::vector<HistoryRow>& rows = c.history.rows;
    const bool loaded = !c.history.load_names.empty();
    Json time = Json::array(), load = Json::array(), displacement = Json::array(), broken = Json::array();
    const std::size_t stride = std::max<std::size_t>(1, rows.size() / most_rows);
    std::size_t breaking = 0;
    for (std::size_t k = 1; k < rows.size(); ++k) breaking += rows[k].broken != rows[k - 1].broken;
    double load_max = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        // Rows at which bonds broke stay, unless they are many: there the curve has its corners.
        const bool breaks = breaking <= most_rows / 3 && k > 0 && rows[k].broken != rows[k - 1].broken;
        if (k % stride != 0 && k + 1 != rows.size() && !breaks) continue;
        time.push_back(rows[k].time);
        broken.push_back(rows[k].broken);
        load_max = std::max(load_max, std::abs(rows[k].load));
        if (loaded) load.push_back(rows[k].load), displacement.push_back(rows[k].displacement);
    }
    Json history{{"time", time}, {"broken", broken}};
    if (loaded) history["load"] = load, history["displacement"] = displacement;
    const double end = rows.empty() ? 0 : rows.back().time;
    const double until = c.summary.events.separation ? c.summary.events.separation->time : end;
    Json list = Json::array();
    for (std::size_t k = 0; k < places.size(); ++k) {
        const ChartPlace& p = places[k];
        list.push_back({{"axes", {p.axes.x, p.axes.y, p.axes.width, p.axes.height}},
                        {"x", p.x},
                        {"y", p.y},
                        {"x_logarithmic", p.x_logarithmic},
                        {"y_logarithmic", p.y_logarithmic},
                        {"of_time", charts[k].x.unit == "s"},
                        {"until", until}});
    }
    double step = 0;
    for (std::size_t k = 1; k < c.frame_times.size(); ++k) {
        const double d = c.frame_times[k] - c.frame_times[k - 1];
        if (d > 1e-9 * end) step = step > 0 ? std::min(step, d) : d;
    }
    return {{"fps", c.fps},
            {"frames", c.frame_times},
            {"poster", c.poster.empty() ? Json() : Json(c.poster_time)},
            {"breaks", c.summary.broken > 0},
            {"history", history},
            {"scales",
             {{"time", scale_json(end, step > 0 ? step : end / 1000, "s")},
              {"load", scale_json(load_max, load_max / 1000, "N")}}},
            {"charts", list}};
}

std::string charts_html(const std::vector<Chart>& charts, std::vector<ChartPlace>& places) {
    std::string text;
    for (const Chart& chart : charts) {
        ChartPlace place;
        const std::string drawn = chart_in_both_themes(chart, 85, &place);
        const std::string view = drawn.substr(drawn.find("viewBox=") + 9);
        places.push_back(place);
        const PixelRect& a = place.axes;
        text += fmt::format(
            "<figure class=\"chart\">{}"
            "<svg class=\"cursor no-print\" viewBox=\"{}\" tabindex=\"0\" role=\"slider\" "
            "aria-label=\"Moment of the run, on the curve {} over {}\" aria-valuenow=\"0\">"
            "<line x1=\"0\" x2=\"0\" y1=\"{:.2f}\" y2=\"{:.2f}\"/>{}</svg></figure>\n",
            drawn, view.substr(0, view.find('"')), escaped(chart.y.title), escaped(chart.x.title), a.y,
            a.y + a.height, chart.x.unit == "s" ? "" : "<circle cx=\"0\" cy=\"0\" r=\"3.2\"/>");
    }
    return text;
}

/// The picture that suits the theme.
std::string in_both_themes(const std::string& light, const std::string& dark, const char* alternative) {
    return fmt::format(
        "<img class=\"light\" alt=\"{0}\" src=\"{1}\"><img class=\"dark\" alt=\"{0}\" src=\"{2}\">",
        alternative, data_uri("image/png", light), data_uri("image/png", dark));
}

std::string film_html(const PageContent& c) {
    const std::string alternative = escaped(c.caption);
    std::string text = "<figure class=\"film\" id=\"film\">\n";
    if (!c.film.empty())
        text += fmt::format(
            "<video muted playsinline controls preload=\"auto\" aria-label=\"{}\"{} "
            "src=\"{}\"></video>\n",
            alternative,
            c.poster.empty() ? "" : fmt::format(" poster=\"{}\"", data_uri("image/png", c.poster)),
            data_uri(c.film_type, c.film));
    if (!c.poster.empty())
        text += fmt::format("<img class=\"{}\" alt=\"{}\" src=\"{}\">\n", c.film.empty() ? "" : "only-print",
                            alternative, data_uri("image/png", c.poster));
    text += "</figure>\n<div class=\"bar\">\n";
    if (!c.film.empty()) text += "<button id=\"play\" type=\"button\">Play</button>\n";
    for (const auto& [name, event] : events_of(c.summary.events))
        if (*event)
            text +=
                fmt::format("<button type=\"button\" data-time=\"{}\">{}</button>\n", (*event)->time, name);
    text += "<output id=\"readout\" aria-live=\"off\"></output>\n</div>\n";
    if (!c.film.empty())
        text +=
            "<p class=\"keys faint\"><kbd>Space</kbd> plays and pauses, <kbd>←</kbd> <kbd>→</kbd> go one "
            "frame, with "
            "<kbd>Shift</kbd> one second, <kbd>Home</kbd> and <kbd>End</kbd> to the ends. A click on a curve "
            "goes to that "
            "moment.</p>\n";
    return text;
}

}  // namespace

std::string report_page(const PageContent& c) {
    const RunSummary& s = c.summary;
    const Provenance provenance = provenance_of(s);
    const std::vector<Chart> charts = run_charts(c.history, s.events);
    std::vector<ChartPlace> places;
    const std::string curves = charts_html(charts, places);

    std::string page = page_head(s.title, provenance);
    page += fmt::format("<header><div><h1>{}</h1>\n", escaped(s.title));
    if (!c.about.empty()) page += fmt::format("<p class=\"faint\">{}</p>", escaped(c.about));
    page += "</div>" + theme_button() + "</header>\n<main>\n";
    page += fmt::format("<p class=\"outcome\">{}</p>\n", escaped(outcome(s)));
    if (!s.trusted) page += verdict(s);  // before the film is believed
    page += "<div class=\"stage\"><div>\n" + film_html(c) + "</div>\n";
    if (!curves.empty())
        page += "<section class=\"charts\" aria-label=\"Curves\">\n" + curves + "</section>\n";
    page += "</div>\n";
    if (!c.key_frames.empty()) {
        page += "<h2>Key frames</h2>\n<ul class=\"strip\">\n";
        for (const PageKeyFrame& k : c.key_frames)
            page += fmt::format(
                "<li><button class=\"key\" type=\"button\" data-time=\"{}\">{}<strong>{}</strong>"
                "<span class=\"faint\">{}</span></button></li>\n",
                k.time, in_both_themes(k.light, k.dark, ""), escaped(k.label), escaped(k.detail));
        page += "</ul>\n";
    }
    if (!c.cracks_light.empty())
        page += fmt::format(
            "<h2>Crack history</h2>\n<figure class=\"cracks\">{}</figure>\n",
            in_both_themes(c.cracks_light, c.cracks_dark,
                           "Each broken bond in the unloaded body, coloured by its time of breaking"));
    page += "<h2>Results</h2>\n";
    if (s.trusted) page += verdict(s);
    for (const std::string& warning : s.warnings)
        page += fmt::format("<p class=\"warning\"><strong>Warning:</strong> {}</p>\n", escaped(warning));
    page += results(s);
    page += fmt::format("<h2>How it was made</h2>\n<p>{}</p>\n", escaped(c.description));
    page += fmt::format(
        "<div class=\"command\"><pre id=\"command\">{}</pre><button id=\"copy\" "
        "type=\"button\">Copy</button></div>\n",
        escaped(provenance.command));
    page += fmt::format(
        "<details><summary>The scene, every default filled in</summary>\n<pre>{}</pre>\n</details>\n",
        escaped(c.scene));
    page += fmt::format("</main>\n<footer>hibi {} · scene {}</footer>\n", escaped(provenance.version),
                        escaped(provenance.scene_hash.substr(0, 16)));
    page += fmt::format("<script type=\"application/json\" id=\"run\">{}</script>\n",
                        script_safe(run_json(c, charts, places)));
    page += fmt::format("<script>\n{}</script>\n</body>\n</html>\n", page_script);
    return page;
}

}  // namespace hibi
