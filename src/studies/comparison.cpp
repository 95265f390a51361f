#include "studies/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/units.hpp"
#include "image/canvas.hpp"
#include "image/layout.hpp"

namespace hibi {

namespace {

constexpr double label_row = 1.9;  // height of a panel's label, in text sizes

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

}  // namespace

Comparison::Comparison(const CompareOptions& options, std::vector<ComparedRun> runs)
    : runs_(std::move(runs)), clock_(common_clock(runs_)) {
    plan_films(runs_, clock_);
    const DrawingStyle first = film_style(runs_[0].scene, *runs_[0].run);
    view_ = first.view;
    view_.transparent = false;  // panels stand side by side on one background
    if (options.size) view_.width = (*options.size)[0], view_.height = (*options.size)[1];
    const std::array<double, 2> range = common_range(runs_, view_);
    std::erase_if(view_.show, [](const std::string& part) { return part == "load" || part == "counts"; });

    overlay_ = std::make_unique<Overlay>(view_, content(options, range));
    const PixelRect plot = overlay_->plot();
    text_ = lay_out(view_.width, view_.height, {}).text;
    const std::array<double, 4> box = common_box(runs_, first.origin);
    const int count = static_cast<int>(runs_.size());
    const int columns = columns_for(count, plot, box, label_row * text_, options.columns);
    const int rows = (count + columns - 1) / columns;
    const int width = 2 * static_cast<int>(plot.width / columns / 2);
    const int height = 2 * static_cast<int>((plot.height / rows - label_row * text_) / 2);
    View panel = view_;
    panel.width = width;
    panel.height = height;
    std::erase_if(panel.show, [](const std::string& part) { return part != "supports" && part != "loads"; });
    panel.window.reset();
    panel.stroke = 0.75 * symbol_unit(view_) / symbol_unit(panel);
    for (int k = 0; k < count; ++k) {
        ComparedRun& m = runs_[static_cast<std::size_t>(k)];
        m.cell = {std::floor(plot.x + k % columns * plot.width / columns),
                  std::floor(plot.y + k / columns * plot.height / rows), static_cast<double>(width),
                  label_row * text_ + height};
        m.drawing = std::make_unique<RunDrawing>(m.scene, *m.run,
                                                 DrawingStyle{.view = panel,
                                                              .title = {},
                                                              .range = range,
                                                              .plan = m.plan,
                                                              .origin = first.origin,
                                                              .window = box,
                                                              .event_labels = false},
                                                 options.renderer);
    }
}

int Comparison::poster() const {
    std::vector<int> frames;
    for (const ComparedRun& m : runs_) {
        const FilmPlan own = film_style(m.scene, *m.run).plan;
        const auto at = std::ranges::lower_bound(m.plan.time, own.time[own.poster]);
        frames.push_back(
            std::min(static_cast<int>(at - m.plan.time.begin()), static_cast<int>(m.plan.time.size()) - 1));
    }
    std::ranges::sort(frames);
    return frames[frames.size() / 2];
}

int Comparison::draw(int frame, Image& image, std::optional<int> next) {
    fill(image);
    int broken = 0;
    for (ComparedRun& m : runs_) {
        broken += m.drawing->draw(frame, panel_, next);
        const int x = static_cast<int>(m.cell.x), y = static_cast<int>(m.cell.y + label_row * text_);
        for (int row = 0; row < panel_.height; ++row)
            std::memcpy(image.pixel(x, y + row), panel_.pixel(0, row),
                        4 * static_cast<std::size_t>(panel_.width));
    }
    draw_labels(frame, image);
    overlay_->draw(image, {.time = clock(frame),
                           .event = {},
                           .speed = runs_[0].plan.speed(frame),
                           .pixels_per_metre = runs_[0].drawing->pixels_per_metre(),
                           .symbols = {}});
    return broken;
}

void Comparison::fill(Image& image) const {
    const Rgb& c = theme(view_.theme).background;
    std::array<std::uint8_t, 4> pixel{};
    for (int k = 0; k < 3; ++k) pixel[k] = static_cast<std::uint8_t>(std::lround(255 * c[2 - k]));
    for (std::size_t at = 0; at < image.bgra.size(); at += 4) std::memcpy(&image.bgra[at], pixel.data(), 4);
}

void Comparison::draw_labels(int frame, Image& image) const {
    const Theme& colours = theme(view_.theme);
    const CairoSurface surface = surface_on(image);
    const CairoPen pen = pen_on(surface);
    cairo_t* cairo = pen.get();
    for (std::size_t k = 0; k < runs_.size(); ++k) {
        const ComparedRun& m = runs_[k];
        const double y = m.cell.y + 1.25 * text_;
        set_colour(cairo, k == 0 ? colours.curve : colours.series[k % colours.series.size()]);
        round_rect(cairo, {m.cell.x, y - 0.72 * text_, 0.8 * text_, 0.8 * text_}, 0.2 * text_);
        cairo_fill(cairo);
        TextStyle right{.size = text_, .colour = colours.faint_text, .tabular = true, .align = Align::right};
        std::string state;
        if (const std::optional<FilmPlan::Label> label = m.plan.label(frame)) {
            state = label->text;
            right.colour = colours.curve_second;
            right.strong = true;
        } else if (m.plan.time[frame] > m.run->states().back().time && m.end() < last_end()) {
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

double Comparison::last_end() const {
    double end = runs_[0].end();
    for (const ComparedRun& m : runs_) end = std::max(end, m.end());
    return end;
}

OverlayContent Comparison::content(const CompareOptions& options, const std::array<double, 2>& range) const {
    const FieldLabel field = field_label(view_.field);
    OverlayContent c;
    c.title = options.title.empty() ? runs_[0].scene.title : options.title;
    c.subtitle = fmt::format("{} runs · one clock", runs_.size());
    if (options.align) {
        std::string event = to_string(*options.align);
        std::ranges::replace(event, '_', ' ');
        c.subtitle = fmt::format("{} runs · Δt counts from each run's {}", runs_.size(), event);
        c.time_symbol = std::string("Δt");
    }
    c.colour_bar = {field.title, field.unit, range[0], range[1], *view_.map};
    c.time_end = std::max(std::abs(clock_.simulated(0)), std::abs(clock_.simulated(clock_.duration())));
    c.time_resolution = runs_[0].plan.smallest_step();
    c.curve = {.x_title = "Displacement", .x_unit = "m", .y_title = "Load", .y_unit = "N"};
    for (std::size_t k = 0; k < runs_.size(); ++k) {
        const ComparedRun& m = runs_[k];
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

}  // namespace hibi
