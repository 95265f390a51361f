#include "pictures/report.hpp"

#include <fmt/format.h>

#include <set>

#include "base/units.hpp"
#include "image/png.hpp"
#include "pictures/draw.hpp"
#include "pictures/figures.hpp"
#include "pictures/key_frames.hpp"
#include "pictures/run_drawing.hpp"
#include "record/files.hpp"
#include "record/provenance.hpp"
#include "report/caption.hpp"
#include "report/page.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

// Pictures of the page, for screens with two pixels per point (pixels).
constexpr int key_frame_width = 560;
constexpr double cracks_dpi = 180;
constexpr double key_frame_text = 22;

std::string read_if_there(const fs::path& file) { return fs::exists(file) ? read_file(file) : ""; }

/// What a caption has to tell beyond what stands on every frame.
std::string setting(const Scene& scene) {
    std::string text;
    std::set<double> spacings;
    for (const BodySpec& body : scene.bodies) spacings.insert(body.spacing(Vec3::Zero(), 0));
    for (const double spacing : spacings)
        text += " · particles " + format_si(spacing, "m", 3, true) + " apart";
    for (const Material& m : scene.materials) {
        if (m.break_strain) text += fmt::format(" · bonds break at {:g} % strain", 100 * *m.break_strain);
        if (m.fracture_energy) text += fmt::format(" · fracture energy {:g} J/m²", *m.fracture_energy);
    }
    return text;
}

std::string png_bytes(const Image& image) {
    const std::vector<unsigned char> bytes = encode_png(image, {.small = true});
    return {bytes.begin(), bytes.end()};
}

}  // namespace

void write_report(const Scene& scene, const RunReader& run, const RendererOptions& renderer) {
    const fs::path& folder = run.folder();
    const std::string description = describe(scene, run.topology());
    const Caption caption =
        caption_of(run.summary(), run.topology(), scene.about, description + setting(scene));
    const FilmPlan plan = film_style(scene, run).plan;
    PageContent page{.summary = run.summary(),
                     .about = scene.about,
                     .description = description,
                     .history = run.history(),
                     .scene = read_if_there(folder / "scene.toml"),
                     .caption = caption.alternative,
                     .poster = read_if_there(folder / "poster.png"),
                     .poster_time = plan.time[static_cast<std::size_t>(plan.poster)],
                     .cracks_light = {},
                     .cracks_dark = {},
                     .film = {},
                     .film_type = {},
                     .frame_times = {},
                     .fps = run.summary().fps > 0 ? run.summary().fps : scene.movie.fps,
                     .key_frames = {}};
    for (const FrameInfo& frame : read_frames(folder)) page.frame_times.push_back(frame.time);
    for (const char* type :
         {"webm", "mp4"})  // what browsers play; nobody knows what a film without times shows
        if (const fs::path film = folder / fmt::format("movie.{}", type);
            fs::exists(film) && !page.frame_times.empty())
            page.film = read_if_there(film), page.film_type = fmt::format("video/{}", type);
    for (const KeyMoment& m : key_moments(scene, run))
        page.key_frames.push_back({m.time, m.label, m.detail, {}, {}});
    for (const char* theme : {"light", "dark"}) {
        const bool dark = theme == std::string("dark");
        StillDrawing stills(scene, run, theme, key_frame_width, key_frame_text, renderer);
        for (PageKeyFrame& k : page.key_frames) (dark ? k.dark : k.light) = png_bytes(stills.draw(k.time));
        if (run.summary().broken == 0) continue;
        const FigureStyle style{.theme = theme, .dpi = cracks_dpi};
        (dark ? page.cracks_dark : page.cracks_light) = png_bytes(cracks_image(scene, run, style, renderer));
    }
    write_file(folder / "report.html", report_page(page));

    const std::string label = fs::absolute(folder).lexically_normal().filename().string();
    write_file(folder / "caption.md",
               caption_markdown(caption, scene.title) + "\n" + to_html_comment(provenance_of(run.summary())));
    fs::create_directories(folder / "snippets");
    write_file(folder / "snippets/figure.tex", latex_snippet(caption, label, film_in(folder)));
    write_file(folder / "snippets/figure.qmd", quarto_snippet(caption, label, film_in(folder)));
    write_file(folder / "snippets/figure.md", markdown_snippet(caption, film_in(folder)));
}

}  // namespace hibi
