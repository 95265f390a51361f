#include "app/compare.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "app/draw.hpp"
#include "app/frame_writer.hpp"
#include "app/progress.hpp"
#include "app/run_drawing.hpp"
#include "app/whole_run.hpp"
#include "base/units.hpp"
#include "image/canvas.hpp"
#include "image/layout.hpp"
#include "image/text.hpp"
#include "record/leftovers.hpp"
#include "record/provenance.hpp"
#include "record/summary.hpp"
#include "scene/read.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

constexpr double label_row = 1.9;  // height of a panel's label, in text sizes

/// A run, and where its zero lies on the common clock.
struct Member {
    Scene scene;
    std::unique_ptr<RunReader> run;
    std::string label;
    double zero = 0;  ///< simulated time at which the common clock says 0 (s)
    FilmPlan plan{.map = TimeMap(0, 0, 1, {}, {})};
    std::unique_ptr<RunDrawing> drawing{};
    PixelRect cell{};  ///< label and picture, in the frame

    double begin() const { return run->states().front().time - zero; }
    double end() const { return run->states().back().time - zero; }
};

std::vector<Member> read_members(const CompareOptions& options) {
    if (options.folders.size() < 2)
        throw std::invalid_argument(
            "at least two runs are needed; write for example: hibi compare out/a out/b");
    if (!options.labels.empty() && options.labels.size() != options.folders.size())
        throw std::invalid_argument(fmt::format("{} labels for {} runs; give one for each, in their order",
                                                options.labels.size(), options.folders.size()));
    std::vector<Member> members;
    for (const fs::path& folder : options.folders) {
        if (!holds_run(folder))
            throw std::invalid_argument(
                fmt::format("{} holds no run; a run is made by: hibi run SCENE", folder.string()));
        Member member{
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
    for (std::size_t k = 0; k < members.size(); ++k) members[k].label = labels[k];
    return members;
}

/// From the first beginning to the last end; slow where the first run's scene says so, else from the earliest
/// first break to the latest separation.
TimeMap common_clock(const std::vector<Member>& members) {
    double begin = members[0].begin(), end = members[0].end();
    std::optional<Emphasis> emphasis;
    for (const Member& m : members) {
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

void plan_members(std::vector<Member>& members, const TimeMap& clock) {
    const MovieSpec& movie = members[0].scene.movie;
    const double end = clock.simulated(clock.duration());
    for (Member& m : members) {
        m.plan = {.map = clock.shifted(m.zero), .duration = movie.duration, .flash = movie.flash};
        Events events = m.run->summary().events;
        // A load that never fell has no peak worth a label.
        if (events.peak_load && events.peak_load->time >= m.run->states().back().time)
            events.peak_load.reset();
        m.plan.set_frames(movie.frames(), events, end + m.zero);
    }
}

/// The columns that make the bodies largest, unless the user says how many.
int columns_for(int panels, const PixelRect& plot, const std::array<double, 4>& box, double label,
                int wanted) {
    if (wanted > 0) return std::min(wanted, panels);
    int best = 1;
    double largest = 0;
    for (int columns = 1; columns <= panels; ++columns) {
        const int rows = (panels + columns - 1) / columns;
        const double scale = std::min(plot.width / columns / (box[2] - box[0]),
                                      (plot.height / rows - label) / (box[3] - box[1]));
        if (scale > largest * (1 + 1e-9)) largest = scale, best = columns;
    }
    return best;
}

std::array<double, 4> common_box(const std::vector<Member>& members) {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 4> box{far, far, -far, -far};
    for (const Member& m : members) {
        const std::array<double, 4> own = m.scene.view.window.value_or(body_window(*m.run, m.scene.view));
        for (int k = 0; k < 4; ++k) box[k] = k < 2 ? std::min(box[k], own[k]) : std::max(box[k], own[k]);
    }
    return box;
}

std::array<double, 2> common_range(const std::vector<Member>& members, const View& view) {
    if (view.range) return *view.range;
    std::array<double, 2> range{0, 0};
    for (const Member& m : members) {
        const auto own = colour_range(*m.run, view.field, *view.map == "diverging");
        range = {std::min(range[0], own[0]), std::max(range[1], own[1])};
    }
    return range;
}

/// The comparison, ready to be drawn frame by frame.
class Comparison {
 public:
    Comparison(const CompareOptions& options, std::vector<Member> members)
        : members_(std::move(members)), clock_(common_clock(members_)) {
        plan_members(members_, clock_);
        const DrawingStyle first = film_style(members_[0].scene, *members_[0].run);
        view_ = first.view;
        view_.transparent = false;  // panels stand side by side on one background
        if (options.size) view_.width = (*options.size)[0], view_.height = (*options.size)[1];
        const std::array<double, 2> range = common_range(members_, view_);
        std::erase_if(view_.show, [](const std::string& part) { return part == "load" || part == "counts"; });

        overlay_ = std::make_unique<Overlay>(view_, content(options, range));
        const PixelRect plot = overlay_->plot();
        text_ = lay_out(view_.width, view_.height, {}).text;
        const std::array<double, 4> box = common_box(members_);
        const int count = static_cast<int>(members_.size());
        const int columns = columns_for(count, plot, box, label_row * text_, options.columns);
        const int rows = (count + columns - 1) / columns;
        const int width = 2 * static_cast<int>(plot.width / columns / 2);
        const int height = 2 * static_cast<int>((plot.height / rows - label_row * text_) / 2);
        View panel = view_;
        panel.width = width;
        panel.height = height;
        std::erase_if(panel.show,
                      [](const std::string& part) { return part != "supports" && part != "loads"; });
        panel.window.reset();
        panel.stroke = 0.75 * symbol_unit(view_) / symbol_unit(panel);
        for (int k = 0; k < count; ++k) {
            Member& m = members_[static_cast<std::size_t>(k)];
            m.cell = {std::floor(plot.x + k % columns * plot.width / columns),
                      std::floor(plot.y + k / columns * plot.height / rows), static_cast<double>(width),
                      label_row * text_ + height};
            m.drawing = std::make_unique<RunDrawing>(m.scene, *m.run,
                                                     DrawingStyle{.view = panel,
                                                                  .title = {},
                                                                  .range = range,
                                                                  .plan = m.plan,
                                                                  .window = box,
                                                                  .event_labels = false},
                                                     options.renderer);
        }
    }

    int width() const { return view_.width; }
    int height() const { return view_.height; }
    int frames() const { return static_cast<int>(members_[0].plan.time.size()); }
    double clock(int frame) const { return members_[0].plan.time[frame] - members_[0].zero; }
    const FilmPlan& plan(int member) const { return members_[member].plan; }

    /// Of the frames that tell most of each run, the middle one.
    int poster() const {
        std::vector<int> frames;
        for (const Member& m : members_) {
            const FilmPlan own = film_style(m.scene, *m.run).plan;
            const auto at = std::ranges::lower_bound(m.plan.time, own.time[own.poster]);
            frames.push_back(std::min(static_cast<int>(at - m.plan.time.begin()),
                                      static_cast<int>(m.plan.time.size()) - 1));
        }
        std::ranges::sort(frames);
        return frames[frames.size() / 2];
    }

    /// Returns how many bonds are shown as broken.
    int draw(int frame, Image& image, std::optional<int> next = {}) {
        fill(image);
        int broken = 0;
        for (Member& m : members_) {
            broken += m.drawing->draw(frame, panel_, next);
            const int x = static_cast<int>(m.cell.x), y = static_cast<int>(m.cell.y + label_row * text_);
            for (int row = 0; row < panel_.height; ++row)
                std::memcpy(image.pixel(x, y + row), panel_.pixel(0, row),
                            4 * static_cast<std::size_t>(panel_.width));
        }
        draw_labels(frame, image);
        overlay_->draw(image, {.time = clock(frame),
                               .event = {},
                               .speed = members_[0].plan.speed(frame),
                               .pixels_per_metre = members_[0].drawing->pixels_per_metre(),
                               .symbols = {}});
        return broken;
    }

 private:
    void fill(Image& image) const {
        const Rgb& c = theme(view_.theme).background;
        std::array<std::uint8_t, 4> pixel{};
        for (int k = 0; k < 3; ++k) pixel[k] = static_cast<std::uint8_t>(std::lround(255 * c[2 - k]));
        for (std::size_t at = 0; at < image.bgra.size(); at += 4)
            std::memcpy(&image.bgra[at], pixel.data(), 4);
    }

    void draw_labels(int frame, Image& image) const {
        const Theme& colours = theme(view_.theme);
        const CairoSurface surface = surface_on(image);
        const CairoPen pen = pen_on(surface);
        cairo_t* cairo = pen.get();
        for (std::size_t k = 0; k < members_.size(); ++k) {
            const Member& m = members_[k];
            const double y = m.cell.y + 1.25 * text_;
            set_colour(cairo, k == 0 ? colours.curve : colours.series[k % colours.series.size()]);
            round_rect(cairo, {m.cell.x, y - 0.72 * text_, 0.8 * text_, 0.8 * text_}, 0.2 * text_);
            cairo_fill(cairo);
            TextStyle right{
                .size = text_, .colour = colours.faint_text, .tabular = true, .align = Align::right};
            std::string state;
            if (const std::optional<FilmPlan::Label> label = m.plan.label(frame)) {
                state = label->text;
                right.colour = colours.curve_second;
                right.strong = true;
            } else if (m.plan.time[frame] > m.run->states().back().time && m.end() < members_longest()) {
                state = std::string("ended");
            } else if (!m.run->topology().loads.empty()) {
                state = format_si(load_at(m.run->history(), m.plan.time[frame]), "N", 3);
            }
            const double edge = m.cell.x + m.cell.width - text_;
            const TextStyle strong{.size = text_, .colour = colours.text, .strong = true};
            const double room = m.cell.width - 3.5 * text_ - type_.width(state, right);
            type_.draw(cairo, type_.shortened(m.label, strong, room), m.cell.x + 1.3 * text_, y, strong);
            type_.draw(cairo, state, edge, y, right);
        }
        cairo_surface_flush(surface.get());
    }

    double members_longest() const {
        double end = members_[0].end();
        for (const Member& m : members_) end = std::max(end, m.end());
        return end;
    }

    OverlayContent content(const CompareOptions& options, const std::array<double, 2>& range) const {
        const FieldLabel field = field_label(view_.field);
        OverlayContent c;
        c.title = options.title.empty() ? members_[0].scene.title : options.title;
        c.subtitle = fmt::format("{} runs · one clock", members_.size());
        if (options.align) {
            std::string event = to_string(*options.align);
            std::ranges::replace(event, '_', ' ');
            c.subtitle = fmt::format("{} runs · Δt counts from each run's {}", members_.size(), event);
            c.time_symbol = std::string("Δt");
        }
        c.colour_bar = {field.title, field.unit, range[0], range[1], *view_.map};
        c.time_end = std::max(std::abs(clock_.simulated(0)), std::abs(clock_.simulated(clock_.duration())));
        c.time_resolution = members_[0].plan.smallest_step();
        c.curve = {.x_title = "Displacement", .x_unit = "m", .y_title = "Load", .y_unit = "N"};
        for (std::size_t k = 0; k < members_.size(); ++k) {
            const Member& m = members_[k];
            c.has_breaks |= std::ranges::any_of(m.scene.materials, &Material::can_break);
            if (m.run->topology().loads.empty()) continue;
            const auto& separation = m.run->summary().events.separation;
            InsetCurve::Other line;
            for (const HistoryRow& row : m.run->history().rows) {
                if (separation && row.time > separation->time) break;
                line.time.push_back(row.time - m.zero);
                line.x.push_back(row.displacement);
                line.y.push_back(row.load);
            }
            if (k == 0)
                c.curve.time = line.time, c.curve.x = line.x, c.curve.y = line.y;
            else
                c.curve.others.push_back(line);
        }
        return c;
    }

    std::vector<Member> members_;
    TimeMap clock_;
    View view_;
    std::unique_ptr<Overlay> overlay_;
    Typesetter type_;
    double text_ = 0;
    Image panel_;
};

void require_folder(const CompareOptions& options) {
    const fs::path& folder = options.output;
    if (options.force || !fs::exists(folder) || fs::is_empty(folder)) return;
    if (fs::exists(folder / "compare.json")) return;
    throw std::runtime_error(
        fmt::format("{}: holds other things than a comparison; choose another folder with -o, or "
                    "add to it with --force",
                    folder.string()));
}

Provenance provenance_of(const CompareOptions& options, const std::string& title) {
    std::vector<std::string> words{"hibi", "compare"};
    for (const fs::path& folder : options.folders) words.push_back(path_word(folder));
    for (const std::string& label : options.labels) words.insert(words.end(), {"--label", label});
    if (!options.title.empty()) words.insert(words.end(), {"--title", options.title});
    if (options.align) words.insert(words.end(), {"--align", to_string(*options.align)});
    if (options.columns > 0) words.insert(words.end(), {"--columns", fmt::format("{}", options.columns)});
    if (options.size)
        words.insert(words.end(), {"--size", fmt::format("{}x{}", (*options.size)[0], (*options.size)[1])});
    words.insert(words.end(), {"-o", path_word(options.output)});
    return {title, HIBI_VERSION, "", "", shell_command(words)};
}

}  // namespace

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

void make_comparison(const CompareOptions& options) {
    std::vector<Member> members = read_members(options);
    require_folder(options);
    fs::create_directories(options.output / "frames");
    remove_pictures(options.output);
    fs::create_directories(options.output / "frames");
    const MovieSpec movie = members[0].scene.movie;
    const Provenance provenance =
        provenance_of(options, options.title.empty() ? members[0].scene.title : options.title);
    Comparison comparison(options, std::move(members));
    const Texts texts = to_texts(provenance);
    // It says of the folder that it is a comparison's, and is there from the beginning.
    write_texts(options.output / "compare.json", texts);

    const Video video{.width = comparison.width(),
                      .height = comparison.height(),
                      .fps = movie.fps,
                      .metadata = {{"title", provenance.title}, {"comment", to_comment(provenance)}},
                      .gif_limit = movie.gif_limit};
    FrameWriter writer(options.output, 2, options.formats.empty() ? movie.formats : options.formats, video);
    Progress progress("drawing", "frames", options.quiet);
    const int poster = comparison.poster();
    for (int k = 0; k < comparison.frames(); ++k) {
        Image image = writer.take();
        FrameInfo info{.file = fmt::format("frames/{:06}.png", k), .time = comparison.clock(k), .sha256 = {}};
        info.broken =
            comparison.draw(k, image, k + 1 < comparison.frames() ? std::optional(k + 1) : std::nullopt);
        for (const EventName name : comparison.plan(0).events[k]) info.events.push_back(to_string(name));
        if (const auto& event = comparison.plan(0).event[k]) info.event = to_string(*event);
        if (k == poster) write_png(options.output / "poster.png", image, {.text = texts, .small = true});
        writer.add(std::move(image), std::move(info), texts);
        progress.at(static_cast<double>(k + 1) / comparison.frames(), k + 1);
    }
    write_frames(options.output, writer.finish());
}

int compare_command(const CompareOptions& options) {
    make_comparison(options);
    fmt::print("{}\n", (options.output / film_in(options.output)).string());
    return 0;
}

}  // namespace hibi
