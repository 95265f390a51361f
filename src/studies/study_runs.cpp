#include "studies/study_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>
#include <thread>

#include "base/process.hpp"
#include "base/progress.hpp"
#include "base/units.hpp"
#include "image/png.hpp"
#include "image/sheet.hpp"
#include "image/text.hpp"
#include "pictures/key_frames.hpp"
#include "record/files.hpp"
#include "record/leftovers.hpp"
#include "record/provenance.hpp"
#include "record/summary.hpp"
#include "record/tables.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

/// What a shell and a file system take without quotes.
std::string file_name(const std::string& text) {
    std::string name;
    for (const char c : text) {
        if (c == ' ') continue;
        const bool plain =
            std::isalnum(static_cast<unsigned char>(c)) || std::string("._=-+,").find(c) != std::string::npos;
        name += plain ? c : '_';
    }
    return name;
}

/// A run that is there, finished, of this very scene and program.
std::optional<RunSummary> finished_run(const fs::path& folder, const std::string& hash, bool with_pictures) {
    if (!fs::exists(folder / "run.json")) return {};
    try {
        RunSummary summary = read_summary(folder);
        if (summary.stopped || summary.scene_hash != hash || summary.version != HIBI_VERSION) return {};
        if (with_pictures && !fs::exists(folder / "report.html")) return {};
        return summary;
    } catch (const std::runtime_error&) {
        return {};
    }
}

/// Every scene is read before anything is run; what is wrong with any of them is told at once.
std::vector<Scene> read_scenes(const std::vector<StudyPoint>& points) {
    std::vector<Scene> scenes;
    std::string complaints;
    for (const StudyPoint& point : points) {
        try {
            scenes.push_back(read_scene(point.scene, point.folded ? Overrides{} : point.overrides));
        } catch (const SceneErrors& errors) {
            complaints += fmt::format("{}{}:\n{}", complaints.empty() ? "" : "\n", point.name, errors.what());
        }
    }
    if (!complaints.empty()) throw std::invalid_argument(complaints);
    return scenes;
}

/// The line that says what went wrong.
std::string error_line(const ProcessEnd& end) {
    if (end.status > 128) return fmt::format("ended by signal {}", end.status - 128);
    const std::size_t at = end.error_output.find("error: ");
    const std::string text = at == std::string::npos ? end.error_output : end.error_output.substr(at + 7);
    const std::string line = text.substr(0, text.find('\n'));
    return line.empty() ? fmt::format("exit status {}", end.status) : line;
}

std::string mode_of(const fs::path& folder, const RunSummary& summary) {
    const RunReader run(folder);
    return failure_mode(summary, run.topology(), read_breaks(folder / "breaks.csv"));
}

}  // namespace

std::vector<std::string> split_values(const std::string& text) {
    std::vector<std::string> values(1);
    int depth = 0;
    for (const char c : text) {
        depth += c == '(' ? 1 : c == ')' ? -1 : 0;
        if (c == ',' && depth <= 0)
            values.emplace_back();
        else
            values.back() += c;
    }
    for (const std::string& value : values)
        if (value.find_first_not_of(' ') == std::string::npos)
            throw std::invalid_argument(
                fmt::format("\"{}\": a value is empty; write for example 2m,1m,0.5m", text));
    return values;
}

Grid read_grid(const std::vector<std::string>& texts) {
    Grid grid;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0)
            throw std::invalid_argument(
                fmt::format("-p \"{}\" is not of the form name=value,value,...", text));
        const std::string name = text.substr(0, equals);
        if (std::ranges::find(grid, name, &Grid::value_type::first) != grid.end())
            throw std::invalid_argument(
                fmt::format("-p {} is given twice; write all its values with commas", name));
        grid.emplace_back(name, split_values(text.substr(equals + 1)));
    }
    return grid;
}

std::vector<StudyPoint> grid_points(const fs::path& scene, const Grid& grid) {
    std::vector<StudyPoint> points{{.overrides = {}, .scene = scene, .name = {}}};
    for (const auto& [name, values] : grid) {
        std::vector<StudyPoint> next;
        for (const StudyPoint& point : points)
            for (const std::string& value : values) {
                next.push_back(point);
                next.back().overrides.emplace_back(name, value);
                next.back().name += (point.name.empty() ? "" : ",") + file_name(name + "=" + value);
            }
        points = std::move(next);
    }
    std::set<std::string> names;
    for (StudyPoint& point : points) {
        const std::string name = point.name;
        for (int k = 2; !names.insert(point.name).second; ++k) point.name = fmt::format("{}_{}", name, k);
    }
    return points;
}

namespace {

/// The same for every way of writing a value: 0.4s for "0.4", "0.4 s" and "400 ms".
std::string plain_value(double value, const std::string& unit) {
    const double size = std::abs(value);
    // A prefix of m/s or kg/m^3 would not help.
    if ((size >= 0.1 && size < 1000) || size == 0 || unit.empty() || unit.find_first_of("/^ ") != unit.npos)
        return fmt::format("{:.10g}{}", value, unit);
    return format_si(value, unit, 10, true);
}

}  // namespace

std::vector<StudyPoint> distinct_points(const std::vector<StudyPoint>& points) {
    std::vector<StudyPoint> distinct;
    std::set<std::vector<double>> seen;
    for (StudyPoint point : points) {
        try {
            std::vector<double> values;
            std::string name;
            const Scene scene = read_scene(point.scene, point.overrides);
            for (const auto& [parameter, text] : point.overrides) {
                const auto& p = *std::ranges::find(scene.params, parameter, &Parameter::name);
                values.push_back(p.value);
                name += (name.empty() ? "" : ",") + file_name(parameter + "=" + plain_value(p.value, p.unit));
            }
            if (!seen.insert(values).second) continue;
            point.name = name;
        } catch (const SceneErrors&) {  // told by run_study, with those of all others
        }
        distinct.push_back(point);
    }
    return distinct;
}

std::vector<StudyRun> run_study(const std::vector<StudyPoint>& points, const StudyOptions& options) {
    const std::vector<Scene> scenes = read_scenes(points);
    std::vector<StudyRun> runs(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
        for (const auto& [name, text] : points[k].overrides) {
            StudyRun::Parameter parameter{name, text, 0, ""};
            for (const Parameter& p : scenes[k].params)
                if (p.name == name) parameter.value = p.value, parameter.unit = p.unit;
            runs[k].parameters.push_back(parameter);
        }
        runs[k].criterion = points[k].criterion;
        runs[k].folder = (options.folder / points[k].name).string();
    }
    const auto run_one = [&](StudyRun& run, const StudyPoint& point, const std::string& hash) {
        if (!options.force) run.summary = finished_run(run.folder, hash, options.pictures);
        if (run.summary) {
            run.kept = true;
            run.status = run.summary->trusted ? 0 : 4;
            run.mode = mode_of(run.folder, *run.summary);
            return;
        }
        std::vector<std::string> words{this_program().string(),
                                       "run",
                                       path_word(point.scene),
                                       "-o",
                                       path_word(run.folder),
                                       "-q",
                                       "--threads",
                                       "1"};
        if (!point.folded)
            for (const auto& [name, value] : point.overrides)
                words.insert(words.end(), {"-p", name + "=" + value});
        if (options.force) words.push_back("--force");
        if (!options.pictures) words.push_back("--no-pictures");
        const ProcessEnd end = run_process(words);
        run.status = end.status;
        if (end.status != 0 && end.status != 4) {
            run.error = error_line(end);
            return;
        }
        const RunSummary summary = read_summary(run.folder);
        run.mode = mode_of(run.folder, summary);
        run.summary = summary;
    };
    Progress progress("running", "runs", options.quiet);
    const int count = static_cast<int>(points.size());
    int done = 0;
    in_parallel(
        count,
        options.jobs > 0 ? options.jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency())),
        [&](int k) {
            try {
                run_one(runs[k], points[k], scene_hash(scenes[k]));
            } catch (const std::exception& error) {  // one folder that cannot be read stops no other run
                runs[k].status = 1;
                runs[k].summary.reset();
                runs[k].error = error.what();
            }
        },
        [&] {
            ++done;
            progress.at(static_cast<double>(done) / count, done);
        });
    const auto kept = std::ranges::count_if(runs, &StudyRun::kept);
    if (kept > 0 && !options.quiet)
        fmt::print(stderr, "{} of {} runs were there already and kept; --force runs them again\n", kept,
                   count);
    return runs;
}

int study_status(const std::vector<StudyRun>& runs) {
    if (!std::ranges::all_of(runs, &StudyRun::done)) return 1;
    return std::ranges::any_of(runs, [](const StudyRun& r) { return r.status == 4; }) ? 4 : 0;
}

void require_study_folder(const fs::path& folder, bool force) {
    if (force || !fs::exists(folder) || fs::is_empty(folder)) return;
    if (fs::exists(folder / "sweep.json") || fs::exists(folder / "converge.json")) return;
    const bool begun = std::ranges::any_of(
        fs::directory_iterator(folder),
        [](const fs::directory_entry& entry) { return entry.is_directory() && holds_run(entry.path()); });
    if (begun && !holds_run(folder)) return;  // an interrupted study
    throw std::runtime_error(fmt::format(
        "{}: holds other things than a study; choose another folder with -o, or add to it with --force",
        folder.string()));
}

void write_sheet(const std::vector<StudyRun>& runs, const fs::path& folder, const std::string& title,
                 const RendererOptions& renderer, const Provenance& provenance) {
    const int count = static_cast<int>(runs.size());
    const int columns = std::clamp(count <= 4 ? 2 : count <= 9 ? 3 : 4, 1, std::max(1, count));
    FigureStyle style{.theme = "light"};
    const int width = panel_width(columns, style);
    std::vector<Panel> panels;
    int height = width / 2;
    for (const StudyRun& study : runs) {
        Panel panel{.image = {}, .label = study.label(), .detail = with_boxes("failed: " + study.error)};
        if (study.done()) {
            const Scene scene = read_recorded_scene(study.folder);
            const RunReader run(study.folder);
            const FilmPlan plan = film_style(scene, run).plan;
            panel.image = StillDrawing(scene, run, style.theme, width, style.text(), renderer)
                              .draw(plan.time[static_cast<std::size_t>(plan.poster)]);
            const auto& first = study.summary->events.first_break;
            panel.detail =
                first ? "first break at " + format_si(first->load, "N") : std::string("nothing breaks");
            height = std::max(height, panel.image.height);
        }
        panels.push_back(std::move(panel));
    }
    for (Panel& panel : panels) {
        if (panel.image.width > 0) continue;
        panel.image = Image(width, height);
        const Rgb& c = theme(style.theme).grid;
        for (int i = 0; i < width * height; ++i)
            for (int k = 0; k < 3; ++k)
                panel.image.bgra[static_cast<std::size_t>(4 * i + k)] =
                    static_cast<std::uint8_t>(255 * c[2 - k]);
    }
    write_png(folder / "sheet.png", make_sheet(panels, with_boxes(title), columns, style),
              {.text = to_texts(provenance), .small = true, .dpi = style.dpi});
}

}  // namespace hibi
