#include "studies/compared_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "image/text.hpp"
#include "pictures/drawing_origin.hpp"
#include "pictures/run_extents.hpp"
#include "record/leftovers.hpp"
#include "record/summary.hpp"
#include "scene/read.hpp"

namespace hibi {

namespace fs = std::filesystem;

std::vector<std::string> labels_of(const std::vector<fs::path>& folders) {
    std::vector<RunSummary> summaries;
    std::map<std::string, std::set<std::string>> values;
    std::set<std::string> titles;
    for (const fs::path& folder : folders) {
        summaries.push_back(fs::exists(folder / "run.json") ? read_summary(folder) : RunSummary{});
        titles.insert(summaries.back().title);
        for (const auto& [name, value] : summaries.back().parameters) values[name].insert(value);
    }
    std::vector<std::string> labels;
    for (std::size_t k = 0; k < folders.size(); ++k) {
        std::string label;
        for (const auto& [name, value] : summaries[k].parameters)
            if (values[name].size() > 1) label += (label.empty() ? "" : ", ") + name + " = " + value;
        labels.push_back(label);
    }
    if (std::set<std::string>(labels.begin(), labels.end()).size() == folders.size()) return labels;
    for (std::size_t k = 0; k < folders.size(); ++k)
        labels[k] = titles.size() == folders.size()
                        ? summaries[k].title
                        : fs::absolute(folders[k]).lexically_normal().filename().string();
    return labels;
}

namespace {

/// Throws std::invalid_argument where a text cannot be drawn, before anything is.
void require_drawable(const std::string& text, const char* option) {
    try {
        require_glyphs(text);
    } catch (const std::runtime_error& error) {
        throw std::invalid_argument(
            fmt::format("\"{}\": {}; give another one with {}", text, error.what(), option));
    }
}

}  // namespace

std::vector<ComparedRun> read_compared_runs(const CompareOptions& options) {
    if (options.folders.size() < 2)
        throw std::invalid_argument(
            "at least two runs are needed; write for example: hibi compare out/a out/b");
    if (!options.labels.empty() && options.labels.size() != options.folders.size())
        throw std::invalid_argument(fmt::format("{} labels for {} runs; give one for each, in their order",
                                                options.labels.size(), options.folders.size()));
    std::vector<ComparedRun> members;
    for (const fs::path& folder : options.folders) {
        if (!holds_run(folder))
            throw std::invalid_argument(
                fmt::format("{} holds no run; a run is made by: hibi run SCENE", folder.string()));
        ComparedRun member{
            .scene = read_recorded_scene(folder), .run = std::make_unique<RunReader>(folder), .label = {}};
        if (member.run->states().empty())
            throw std::invalid_argument(fmt::format("{} holds no recorded state", folder.string()));
        if (options.align) {
            const std::optional<double> time = member.run->summary().events.time_of({*options.align, 0});
            if (!time)
                throw std::invalid_argument(
                    fmt::format("{}: {} did not happen there; align on another event, or leave "
                                "--align out",
                                folder.string(), to_string(*options.align)));
            member.zero = *time;
        }
        members.push_back(std::move(member));
    }
    const std::vector<std::string> labels =
        options.labels.empty() ? labels_of(options.folders) : options.labels;
    for (std::size_t k = 0; k < members.size(); ++k) {
        members[k].label = labels[k];
        require_drawable(labels[k], "--label");
    }
    require_drawable(options.title.empty() ? members[0].scene.title : options.title, "--title");
    return members;
}

TimeMap common_clock(const std::vector<ComparedRun>& members) {
    double begin = members[0].begin(), end = members[0].end();
    std::optional<Emphasis> emphasis;
    for (const ComparedRun& m : members) {
        begin = std::min(begin, m.begin());
        end = std::max(end, m.end());
        const Events& e = m.run->summary().events;
        if (!e.first_break) continue;
        const double first = e.first_break->time - m.zero,
                     last = e.separation ? e.separation->time - m.zero : m.end();
        emphasis =
            emphasis ? Emphasis{std::min(emphasis->first_break, first), std::max(emphasis->separation, last)}
                     : Emphasis{first, last};
    }
    const MovieSpec& movie = members[0].scene.movie;
    std::vector<SlowSpan> slow;
    for (const SlowSpec& spec : movie.slow)
        if (const std::optional<double> around = members[0].run->summary().events.time_of(spec.around)) {
            const double at = *around - members[0].zero;
            slow.push_back({at - spec.span / 5, at + 4 * spec.span / 5, spec.rate});
        }
    return TimeMap(begin, end, movie.duration - movie.hold_seconds(), slow, emphasis);
}

void plan_films(std::vector<ComparedRun>& members, const TimeMap& clock) {
    const MovieSpec& movie = members[0].scene.movie;
    const double end = clock.simulated(clock.duration());
    for (ComparedRun& m : members) {
        m.plan = {.map = clock.shifted(m.zero), .duration = movie.duration, .flash = movie.flash};
        Events events = m.run->summary().events;
        // A load that never fell has no peak worth a label.
        if (events.peak_load && events.peak_load->time >= m.run->states().back().time)
            events.peak_load.reset();
        m.plan.set_frames(movie.frames(), events, end + m.zero);
    }
}

std::array<double, 4> common_box(const std::vector<ComparedRun>& members, const Vec3& origin) {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 4> box{far, far, -far, -far};
    for (const ComparedRun& m : members) {
        const std::array<double, 4> own = m.scene.view.window ? counted_from(origin, *m.scene.view.window)
                                                              : body_window(*m.run, m.scene.view, origin);
        for (int k = 0; k < 4; ++k) box[k] = k < 2 ? std::min(box[k], own[k]) : std::max(box[k], own[k]);
    }
    return box;
}

std::array<double, 2> common_range(const std::vector<ComparedRun>& members, const View& view) {
    if (view.range) return *view.range;
    std::array<double, 2> range{0, 0};
    for (const ComparedRun& m : members) {
        const auto own = colour_range(*m.run, view.field, *view.map == "diverging");
        range = {std::min(range[0], own[0]), std::max(range[1], own[1])};
    }
    return range;
}

}  // namespace hibi
