#include "pictures/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "base/profile.hpp"
#include "image/png.hpp"
#include "pictures/frame_writer.hpp"
#include "pictures/run_drawing.hpp"
#include "record/leftovers.hpp"
#include "record/provenance.hpp"

namespace hibi {

namespace {

PngText png_text(const Provenance& provenance, double time) {
    PngText text = to_texts(provenance);
    text["Software"] = "hibi " HIBI_VERSION;  // also where the run was recorded by another one, or killed
    text["Time"] = fmt::format("{:.9g} s", time);
    return text;
}

}  // namespace

std::string film_in(const std::filesystem::path& folder) {
    for (const std::string& format : film_formats())
        if (std::filesystem::exists(folder / ("movie." + format))) return "movie." + format;
    return {};
}

std::vector<std::string> films(const Scene& scene, const DrawOptions& options) {
    if (!options.movie) return {};
    return options.formats.empty() ? scene.movie.formats : options.formats;
}

StageTimes drawing_stages() {
    return StageTimes({"prepare", "wait for the writers", "wait for states", "read states", "interpolate",
                       "place symbols", "upload", "draw calls", "rasterise", "read back", "overlay", "hash",
                       "write PNG", "encode", "write poster", "finish"});
}

DrawResult draw_run(const Scene& scene, const std::filesystem::path& folder, const DrawOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    const double processor_begin = processor_seconds();
    StageTimes* const profile = options.renderer.profile;
    std::optional<TimedStage> preparing(std::in_place, profile, "prepare");
    const RunReader run(folder);
    RunDrawing drawing(scene, run, film_style(scene, run), options.renderer);
    const FilmPlan& plan = drawing.plan();
    remove_pictures(folder, options.formats.empty());
    const Provenance provenance = followed_by(provenance_of(run.summary()), options.command);

    const int frames = options.movie || options.frames ? static_cast<int>(plan.time.size()) : 0;
    if (options.frames) std::filesystem::create_directories(folder / "frames");
    FrameWriter writer(folder, options.frames ? std::max(1, options.workers) : 0, films(scene, options),
                       {.width = scene.view.width,
                        .height = scene.view.height,
                        .fps = scene.movie.fps,
                        .metadata = {{"title", scene.title}, {"comment", to_comment(provenance)}},
                        .transparent = scene.view.transparent,
                        .background = theme(scene.view.theme).background,
                        .gif_limit = scene.movie.gif_limit},
                       profile);
    const std::filesystem::path poster = folder / "poster.png";
    preparing.reset();
    for (int k = 0; k < frames; ++k) {
        Image image = writer.take();
        FrameInfo info;
        info.broken = drawing.draw(k, image, k + 1 < frames ? std::optional(k + 1) : std::nullopt);
        info.file = fmt::format("frames/{:06}.png", k);
        info.time = plan.time[k];
        if (plan.event[k]) info.event = to_string(*plan.event[k]);
        for (const EventName name : plan.events[k]) info.events.push_back(to_string(name));
        writer.add(std::move(image), std::move(info), png_text(provenance, plan.time[k]),
                   k == plan.poster ? poster : std::filesystem::path());
        if (options.progress) options.progress(k + 1, frames);
    }
    if (frames == 0) {
        Image image(scene.view.width, scene.view.height);
        drawing.draw(plan.poster, image);
        write_png(poster, image, {.text = png_text(provenance, plan.time[plan.poster]), .small = true});
    }
    std::vector<FrameInfo> entries;
    {
        const TimedStage timed(profile, "finish");
        entries = writer.finish();
    }
    if (options.frames) write_frames(folder, entries);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    return {frames, seconds.count(), writer.encode_seconds(), processor_seconds() - processor_begin,
            drawing.renderer()};
}

}  // namespace hibi
