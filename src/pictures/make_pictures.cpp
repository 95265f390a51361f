#include "pictures/make_pictures.hpp"

#include <chrono>

#include "base/progress.hpp"
#include "pictures/figures.hpp"
#include "pictures/report.hpp"
#include "record/summary.hpp"

namespace hibi {

namespace fs = std::filesystem;

void make_pictures(const Scene& scene, const fs::path& folder, DrawOptions options, bool quiet,
                   RunSummary& summary) {
    Progress progress("drawing", "frames", quiet);
    options.progress = [&](int done, int of) { progress.at(static_cast<double>(done) / of, done); };
    const DrawResult drawn = draw_run(scene, folder, options);
    summary.frames = drawn.frames;
    summary.fps = drawn.frames > 0 ? scene.movie.fps : 0;
    summary.seconds["draw"] = drawn.draw_seconds;
    summary.seconds["draw_processor"] = drawn.processor_seconds;
    summary.seconds["encode"] = drawn.encode_seconds;
    if (options.renderer.profile) summary.profile["draw"] = options.renderer.profile->list();
    options.renderer.profile = nullptr;  // what follows draws no frames
    if (!options.report) return;
    const auto figures_begin = std::chrono::steady_clock::now();
    // The report reads there what is said of the film.
    if (fs::exists(folder / "run.json")) write_summary(folder, summary);
    const RunReader run(folder);
    draw_figures(scene, run, options.renderer);
    write_report(scene, run, options.renderer);
    const std::chrono::duration<double> figures = std::chrono::steady_clock::now() - figures_begin;
    summary.seconds["figures"] = figures.count();
}

fs::path main_picture(const fs::path& folder, const DrawOptions& options) {
    if (!options.movie) return folder / "strip.png";
    const std::string film = film_in(folder);
    return folder / (film.empty() ? "frames" : film);
}

}  // namespace hibi
