#include "app/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "app/film_plan.hpp"
#include "app/frame_writer.hpp"
#include "app/marks.hpp"
#include "app/picture.hpp"
#include "base/units.hpp"
#include "image/layout.hpp"
#include "image/overlay.hpp"
#include "image/png.hpp"
#include "scene/read.hpp"

namespace hibi {

namespace {

constexpr double window_margin = 0.03;  // of the larger side of the body's box

/// The window into the plot, with room at the sides for symbols and a margin. A window of the user's is taken
/// as it is.
Camera2 camera_for(const std::array<double, 4>& box, bool fixed, const PixelRect& plot,
                   std::span<const Mark> marks, const View& view) {
    if (fixed) return Camera2::fit(box[0], box[1], box[2], box[3], plot);
    std::array<double, 4> room = room_for(marks, view);
    for (int side = 0; side < 4; ++side)  // small pictures: the body goes before the symbols
        room[side] = std::min(room[side], 0.25 * (side % 2 == 0 ? plot.width : plot.height));
    const PixelRect inner = {plot.x + room[0], plot.y + room[1], plot.width - room[0] - room[2],
                             plot.height - room[1] - room[3]};
    const double margin = window_margin * std::max(box[2] - box[0], box[3] - box[1]);
    Camera2 camera = Camera2::fit(box[0] - margin, box[1] - margin, box[2] + margin, box[3] + margin, inner);
    // The same picture, but clipped to the whole plot.
    camera.centre_x -= (inner.x + inner.width / 2 - plot.x - plot.width / 2) / camera.scale;
    camera.centre_y += (inner.y + inner.height / 2 - plot.y - plot.height / 2) / camera.scale;
    camera.rect = plot;
    return camera;
}

std::string subtitle(const Scene& scene, const Topology& topology) {
    std::string text =
        fmt::format("{} particles · {} bonds", topology.reference_position.size(), topology.first.size());
    for (const Material& m : scene.materials)
        text += fmt::format(" · {}: E = {}, ν = {:g}", m.name, format_si(m.youngs_modulus, "Pa", 3, true),
                            m.poissons_ratio);
    return text + (scene.assumption == Assumption::plane_stress ? " · plane stress" : " · plane strain");
}

/// The history at any moment, straight lines between its rows.
class HistoryAt {
 public:
    explicit HistoryAt(const History& history) : rows_(history.rows) {}
    template <class Value>
    double operator()(double time, Value&& value) const {
        if (rows_.empty()) return 0;
        const auto after = std::ranges::upper_bound(rows_, time, {}, &HistoryRow::time);
        if (after == rows_.begin()) return value(rows_.front());
        if (after == rows_.end()) return value(rows_.back());
        const HistoryRow &a = *(after - 1), &b = *after;
        return value(a) + (time - a.time) / (b.time - a.time) * (value(b) - value(a));
    }

 private:
    const std::vector<HistoryRow>& rows_;
};

/// Driven particles: what they are made to do grows steadily, while their reaction trembles.
double mark_quantity(const Topology& topology, int load, const HistoryRow& row) {
    const bool by_force = topology.loads[load].kind == "force" || topology.loads[load].kind == "pressure";
    const std::vector<double>& values = by_force ? row.loads : row.displacements;
    return load < static_cast<int>(values.size()) ? values[load] : 0;
}

void remove_old_pictures(const std::filesystem::path& folder) {
    for (const char* name : {"frames.json", "movie.mp4", "movie.mp4.tmp", "poster.png", "poster.png.tmp"})
        std::filesystem::remove(folder / name);
    if (!std::filesystem::is_directory(folder / "frames")) return;
    std::vector<std::filesystem::path> old;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "frames")) {
        const std::string name = entry.path().filename().string();
        const std::string number = name.substr(0, name.find('.'));
        const std::string rest = name.substr(number.size());
        if (!number.empty() && number.find_first_not_of("0123456789") == std::string::npos &&
            (rest == ".png" || rest == ".png.tmp"))
            old.push_back(entry.path());
    }
    for (const std::filesystem::path& file : old) std::filesystem::remove(file);
    if (std::filesystem::is_empty(folder / "frames")) std::filesystem::remove(folder / "frames");
}

/// One run, ready to be drawn frame by frame.
class RunDrawing {
 public:
    RunDrawing(const Scene& scene, const RunReader& run, const RendererOptions& options)
        : run_(run),
          view_(shown_view(scene)),
          range_(scene.view.range ? *scene.view.range : colour_range(run, scene.view.field)),
          plan_(plan_film(scene.movie, run.summary().events, run.states().front().time,
                          run.states().back().time)),
          source_(run, view_, range_),
          overlay_(view_, content(scene)),
          renderer_(view_, run.topology(), options),
          marks_(find_marks(run.topology(), view_.shows("supports"), view_.shows("loads"))),
          camera_(camera_for(view_.window ? *view_.window : body_window(run, view_), view_.window.has_value(),
                             overlay_.plot(), marks_, view_)),
          history_(run.history()) {
        unit_ = lay_out(view_.width, view_.height, {}).unit;
        for (int k = 0; k < static_cast<int>(run.topology().loads.size()); ++k) {
            double largest = 0;
            for (const HistoryRow& row : run.history().rows)
                if (row.time <= until())
                    largest = std::max(largest, std::abs(mark_quantity(run.topology(), k, row)));
            largest_.push_back(largest);
        }
    }

    const FilmPlan& plan() const { return plan_; }
    std::string renderer() const { return renderer_.description(); }

    void draw(int frame, Image& image) {
        const double time = plan_.time[frame];
        Picture2 picture = source_.at(time);
        picture.camera = camera_;
        for (std::size_t k = 0; k < picture.broken.size(); ++k)
            picture.freshness[k] =
                static_cast<float>(plan_.freshness(frame, run_.broken_at()[picture.broken[k]]));
        renderer_.draw(picture, image);

        OverlayFrame over{.time = time,
                          .load = history_(time, [](const HistoryRow& row) { return row.load; }),
                          .broken = static_cast<int>(picture.broken.size()),
                          .speed = plan_.speed(frame),
                          .pixels_per_metre = camera_.scale,
                          .symbols = {}};
        if (const std::optional<FilmPlan::Label> label = plan_.label(frame)) {
            over.event = label->text;
            over.event_strength = label->strength;
        }
        for (const Mark& mark : marks_) {
            const double size = mark.load < 0 ? 1 : load_size(mark.load, time);
            over.symbols.push_back(place_mark(mark, source_.x(), source_.y(), camera_, size, unit_));
        }
        overlay_.draw(image, over);
    }

 private:
    /// A signed field without a range of the user's is shown by the map made for it.
    static View shown_view(const Scene& scene) {
        View view = scene.view;
        if (!view.range && field_label(view.field).is_signed) view.map = "diverging";
        return view;
    }

    double until() const {
        const std::optional<Event>& separation = run_.summary().events.separation;
        return separation ? separation->time : std::numeric_limits<double>::infinity();
    }

    double load_size(int load, double time) const {
        if (largest_[load] <= 0) return 0;
        return history_(time,
                        [&](const HistoryRow& row) { return mark_quantity(run_.topology(), load, row); }) /
               largest_[load];
    }

    OverlayContent content(const Scene& scene) const {
        const FieldLabel field = field_label(view_.field);
        OverlayContent c;
        c.title = scene.title;
        c.subtitle = subtitle(scene, run_.topology());
        c.colour_bar = {field.title, field.unit, range_[0], range_[1], view_.map};
        c.has_breaks = std::ranges::any_of(scene.materials, &Material::can_break);
        c.time_end = run_.states().back().time;
        c.time_resolution = plan_.smallest_step();
        if (run_.topology().loads.empty()) return c;
        c.load_title = std::string("Load");
        c.load_unit = std::string("N");
        c.curve = {.x_title = "Displacement", .x_unit = "m", .y_title = "Load", .y_unit = "N"};
        for (const HistoryRow& row : run_.history().rows) {
            if (row.time > until()) break;
            c.load_max = std::max(c.load_max, std::abs(row.load));
            c.curve.time.push_back(row.time);
            c.curve.x.push_back(row.displacement);
            c.curve.y.push_back(row.load);
            if (c.has_breaks) c.curve.broken.push_back(row.broken);
        }
        return c;
    }

    const RunReader& run_;
    View view_;
    std::array<double, 2> range_;
    FilmPlan plan_;
    PictureSource source_;
    Overlay overlay_;
    Renderer renderer_;
    std::vector<Mark> marks_;
    Camera2 camera_;
    HistoryAt history_;
    double unit_ = 1;
    std::vector<double> largest_;  // per load
};

PngText png_text(const RunReader& run, double time) {
    PngText text = {{"Title", run.summary().title},
                    {"Software", "hibi " HIBI_VERSION},
                    {"Scene hash", run.summary().scene_hash},
                    {"Time", fmt::format("{:.9g} s", time)}};
    std::erase_if(text, [](const auto& entry) { return entry.second.empty(); });
    return text;
}

}  // namespace

DrawResult draw_run(const Scene& scene, const std::filesystem::path& folder, const DrawOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    const RunReader run(folder);
    RunDrawing drawing(scene, run, options.renderer);
    const FilmPlan& plan = drawing.plan();
    remove_old_pictures(folder);

    const int frames = options.movie || options.frames ? static_cast<int>(plan.time.size()) : 0;
    if (options.frames) std::filesystem::create_directories(folder / "frames");
    std::optional<Video> video;
    if (options.movie)
        video = Video{.width = scene.view.width,
                      .height = scene.view.height,
                      .fps = scene.movie.fps,
                      .metadata = {{"title", scene.title}, {"comment", "hibi " HIBI_VERSION}}};
    FrameWriter writer(folder, options.frames ? std::max(1, options.workers) : 0, video, scene.view.width,
                       scene.view.height);
    const auto write_poster = [&](const Image& image) {
        write_png(folder / "poster.png", image, png_text(run, plan.time[plan.poster]));
    };
    for (int k = 0; k < frames; ++k) {
        Image image = writer.take();
        drawing.draw(k, image);
        if (k == plan.poster) write_poster(image);
        FrameInfo info;
        info.file = fmt::format("frames/{:06}.png", k);
        info.time = plan.time[k];
        if (plan.event[k]) info.event = to_string(*plan.event[k]);
        writer.add(std::move(image), std::move(info), png_text(run, plan.time[k]));
        if (options.progress) options.progress(k + 1, frames);
    }
    if (frames == 0) {
        Image image(scene.view.width, scene.view.height);
        drawing.draw(plan.poster, image);
        write_poster(image);
    }
    const std::vector<FrameInfo> entries = writer.finish();
    if (options.frames) write_frames(folder, entries);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    return {frames, seconds.count(), writer.encode_seconds(), drawing.renderer()};
}

void draw_setup(const Scene& scene, const std::filesystem::path& png, const DrawOptions& options) {
    const Topology topology = topology_of(scene, build(scene));
    View view = scene.view;
    view.map = "viridis";  // stands for the body's number here, not for a field
    view.show = {"title", "scale_bar", "supports", "loads"};
    const std::vector<Mark> marks =
        find_marks(topology, scene.view.shows("supports"), scene.view.shows("loads"));
    const Overlay overlay(view, {.title = scene.title, .subtitle = subtitle(scene, topology)});
    Renderer renderer(view, topology, options.renderer);

    Picture2 picture;
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 4> box{far, far, -far, -far};
    std::vector<double> x, y;
    for (std::size_t i = 0; i < topology.reference_position.size(); ++i) {
        const Vec3& X = topology.reference_position[i];
        const double r = topology.spacing[i] / 2;
        box = {std::min(box[0], X.x() - r), std::min(box[1], X.y() - r), std::max(box[2], X.x() + r),
               std::max(box[3], X.y() + r)};
        x.push_back(X.x());
        y.push_back(X.y());
        picture.value.push_back((static_cast<float>(topology.body[i]) + 0.5f) /
                                static_cast<float>(topology.body_names.size()));
    }
    picture.x.assign(x.begin(), x.end());
    picture.y.assign(y.begin(), y.end());
    picture.intact = drawn_bonds(topology, view.bonds);
    picture.camera =
        camera_for(view.window ? *view.window : box, view.window.has_value(), overlay.plot(), marks, view);

    Image image(view.width, view.height);
    renderer.draw(picture, image);
    OverlayFrame over{.pixels_per_metre = picture.camera.scale, .symbols = {}};
    const double unit = lay_out(view.width, view.height, {}).unit;
    for (const Mark& mark : marks) over.symbols.push_back(place_mark(mark, x, y, picture.camera, 1, unit));
    for (const std::array<Vec3, 2>& cut : topology.notches) {
        Symbol notch;
        notch.kind = Symbol::Kind::notch;
        for (const Vec3& p : cut)
            notch.points.push_back({picture.camera.pixel_x(p.x()), picture.camera.pixel_y(p.y())});
        over.symbols.push_back(notch);
    }
    overlay.draw(image, over);
    write_png(png, image, {{"Title", scene.title}, {"Software", "hibi " HIBI_VERSION}}, true);
}

}  // namespace hibi
