#include "studies/converge.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "breaking/plane_fracture.hpp"
#include "image/png.hpp"
#include "record/files.hpp"
#include "record/provenance.hpp"
#include "scene/scene_file.hpp"
#include "studies/compare.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

/// Of the bodies, the smallest: it is the one that is refined.
double spacing_of(const Scene& scene) {
    double spacing = scene.bodies[0].spacing(Vec3::Zero(), 0);
    for (const BodySpec& body : scene.bodies) spacing = std::min(spacing, body.spacing(Vec3::Zero(), 0));
    return spacing;
}

const char* criterion_of(const Scene& scene) {
    bool strain = false, energy = false;
    for (const Material& m : scene.materials)
        strain |= m.break_strain.has_value(), energy |= m.fracture_energy.has_value();
    return strain && energy ? "" : strain ? "fixed strain" : energy ? "fracture energy" : "";
}

/// Coarse to fine. Throws std::invalid_argument where nothing is refined.
std::vector<StudyPoint> sorted_points(const ConvergeOptions& options, const Grid& grid) {
    std::vector<StudyPoint> points = distinct_points(grid_points(options.scene, grid));
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < points.size(); ++k)
        order.emplace_back(-spacing_of(read_scene(options.scene, points[k].overrides)), k);
    std::ranges::stable_sort(order);
    if (order.front().first == order.back().first)
        throw std::invalid_argument(
            fmt::format("{} does not change the spacing of the particles; hibi sweep varies any parameter",
                        grid[0].first));
    std::vector<StudyPoint> sorted;
    for (const auto& [spacing, k] : order) sorted.push_back(points[k]);
    return sorted;
}

}  // namespace

Scene with_other_criterion(Scene scene, double spacing) {
    for (Material& m : scene.materials) {
        Material unit = m;
        unit.fracture_energy = 1;
        // Limit of the bonds between nearest neighbours for Gc = 1 J/m^2: in an even pull they break first.
        const double strain_of_one =
            fracture_strain(unit, scene.assumption, scene.influence, spacing, spacing);
        if (m.break_strain) {
            m.fracture_energy = std::pow(*m.break_strain / strain_of_one, 2);
            m.break_strain.reset();
        } else if (m.fracture_energy) {
            m.break_strain = strain_of_one * std::sqrt(*m.fracture_energy);
            m.fracture_energy.reset();
        }
    }
    return scene;
}

ConvergeResult run_convergence(ConvergeOptions options) {
    require_file(options.scene);
    const Grid grid = read_grid(options.grid);
    if (grid.size() != 1 || grid[0].second.size() < 2)
        throw std::invalid_argument(
            "hibi converge needs one parameter with two values or more, for example "
            "-p spacing=2m,1m,0.5m");
    StudyOptions& study = options.study;
    if (study.folder.empty()) study.folder = fs::path("out") / (options.scene.stem().string() + "_converge");
    require_study_folder(study.folder, study.force);
    fs::create_directories(study.folder);

    std::vector<StudyPoint> points = sorted_points(options, grid);
    const std::size_t count = points.size();
    const Scene coarsest = read_scene(options.scene, points[0].overrides);
    if (std::ranges::none_of(coarsest.materials, &Material::can_break))
        throw std::invalid_argument(
            "no material of this scene can break, so there is no failure load to compare");
    const std::string given = criterion_of(coarsest);
    const bool both = options.both && !given.empty();
    if (both) {
        const std::string other = given == "fixed strain" ? "fracture energy" : "fixed strain";
        for (std::size_t k = 0; k < count; ++k) {
            points[k].criterion = given;
            // -p cannot change a material: the other criterion gets scene files of its own.
            StudyPoint point = points[k];
            point.criterion = other;
            point.name += other == "fixed strain" ? ",fixed_strain" : ",fracture_energy";
            const Scene scene = read_scene(options.scene, point.overrides);
            point.scene = study.folder / (point.name + ".toml");
            point.folded = true;
            write_file(point.scene, write_scene(with_other_criterion(scene, spacing_of(coarsest))));
            points.push_back(point);
        }
    }
    std::vector<StudyRun> runs = run_study(points, study);
    for (std::size_t k = count; k < runs.size(); ++k) runs[k].parameters = runs[k - count].parameters;

    std::vector<std::string> words{"hibi", "converge", path_word(options.scene), "-p", options.grid[0]};
    if (!options.both) words.push_back("--one");
    words.insert(words.end(), {"-o", path_word(study.folder)});
    const Provenance provenance{coarsest.title, HIBI_VERSION, "", "", shell_command(words)};
    const Convergence verdict = judge_convergence(runs);
    const std::string json = study_json(runs, coarsest.title, provenance.command);
    write_file(study.folder / "converge.csv", study_csv(runs, to_comment(provenance)));
    write_file(study.folder / "converge.json", json);
    write_file(study.folder / "caption.md", fmt::format("{}: {}\n", coarsest.title, verdict.caption));
    write_sheet(runs, study.folder, coarsest.title, options.renderer, provenance);
    const FigureStyle style{.theme = "light"};
    const std::vector<Chart> charts = convergence_charts(runs);
    write_png(study.folder / "plot.png", chart_image(charts, style),
              {.text = to_texts(provenance), .small = true, .dpi = style.dpi});
    write_file(study.folder / "plot.svg", chart_svg(charts, style, nullptr, to_comment(provenance)));

    CompareOptions film{
        .folders = {}, .output = study.folder / "film", .title = coarsest.title + (both ? ", " + given : "")};
    for (std::size_t k = 0; k < count; ++k)
        if (runs[k].done())
            film.folders.push_back(runs[k].folder),
                film.labels.push_back(grid[0].first + " = " + runs[k].parameters[0].text);
    film.quiet = study.quiet;
    film.renderer = options.renderer;
    if (options.film && film.folders.size() > 1) make_comparison(film);
    return {runs, json, verdict};
}

}  // namespace hibi
