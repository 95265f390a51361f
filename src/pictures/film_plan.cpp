#include "pictures/film_plan.hpp"

#include <algorithm>
#include <cmath>

namespace hibi {

namespace {

constexpr double label_fading = 0.3;  // seconds of playback
/// A label names a moment: in a short film it must not outlast what it names.
constexpr double label_share = 0.08;
/// The part of a slow span that lies before its event.
constexpr double slow_lead = 0.2;

std::string words(EventName event) {
    switch (event) {
        case EventName::first_break:
            return "First break";
        case EventName::peak_load:
            return "Peak load";
        case EventName::separation:
            return "Separation";
        default:
            return "";
    }
}

/// First frame at or after a time; none where the time lies after the last.
std::optional<int> first_frame(const std::vector<double>& times, double time) {
    const auto found = std::ranges::lower_bound(times, time);
    if (found == times.end()) return {};
    return static_cast<int>(found - times.begin());
}

TimeMap time_map(const MovieSpec& movie, const Events& events, double begin, double end) {
    std::vector<SlowSpan> slow;
    for (const SlowSpec& spec : movie.slow) {
        const std::optional<double> around = events.time_of(spec.around);
        if (!around) continue;
        const double first = std::max(begin, *around - slow_lead * spec.span);
        const double last = std::min(end, *around + (1 - slow_lead) * spec.span);
        if (last > first) slow.push_back({first, last, spec.rate});
    }
    std::optional<Emphasis> emphasis;
    if (events.first_break)
        emphasis = Emphasis{events.first_break->time, events.separation ? events.separation->time : end};
    return TimeMap(begin, end, movie.duration - movie.hold_seconds(), slow, emphasis);
}

/// The moment the scene asks for; else when two thirds of the bonds that break up to separation have done so:
/// the crack is long, its tip still under strain. Without any break the peak load, or the end of the run.
int poster_frame(const FilmPlan& plan, const MovieSpec& movie, const Events& events,
                 std::vector<double> breaks) {
    const int last = static_cast<int>(plan.time.size()) - 1;
    if (movie.poster)
        if (const std::optional<double> time = events.time_of(*movie.poster))
            return first_frame(plan.time, *time).value_or(last);
    const double until = events.separation ? events.separation->time : plan.time.back();
    std::erase_if(breaks, [&](double time) { return !(time <= until); });
    if (breaks.empty())
        return events.peak_load ? first_frame(plan.time, events.peak_load->time).value_or(last) : last;
    std::ranges::sort(breaks);
    return first_frame(plan.time, breaks[breaks.size() * 2 / 3]).value_or(last);
}

}  // namespace

FilmPlan plan_film(const MovieSpec& movie, const Events& events, const std::vector<double>& broken_at,
                   double begin, double end) {
    FilmPlan plan{
        .map = time_map(movie, events, begin, end), .duration = movie.duration, .flash = movie.flash};
    plan.set_frames(movie.frames(), events, end);
    plan.poster = poster_frame(plan, movie, events, broken_at);
    return plan;
}

void FilmPlan::set_frames(int frames, const Events& happened, double end) {
    event.assign(frames, {});
    time.resize(frames);
    for (int k = 0; k < frames; ++k) time[k] = map.simulated(film_time(k));
    time.back() = end;  // to the last bit, so that the last frame is the last state
    // Rounding must not tell the frames that stand still from one another.
    const double begin = time.front();
    for (double& t : time)
        if (end - t < 1e-12 * (end - begin)) t = end;
    events.assign(frames, {});
    const auto mark = [&](int frame, EventName name) {
        event[frame] = name;
        events[frame].push_back(name);
    };
    mark(0, EventName::start);
    mark(*first_frame(time, end), EventName::end);
    for (const EventName name : {EventName::peak_load, EventName::first_break, EventName::separation})
        // A load that never fell has no peak worth a label: it is simply the end. Nor has one under which
        // nothing broke: it is as large as the scene made it.
        if (const std::optional<double> at = happened.time_of({name, 0});
            at && !(name == EventName::peak_load && (!happened.first_break || *at >= end)))
            if (const std::optional<int> frame = first_frame(time, *at)) mark(*frame, name);
}

double FilmPlan::film_time(int frame) const {
    const int last = static_cast<int>(time.size()) - 1;
    return last > 0 ? duration * frame / last : duration;
}

std::optional<FilmPlan::Label> FilmPlan::label(int frame) const {
    const double label_duration = label_share * duration;
    for (int k = frame; k >= 0; --k) {
        const double age = film_time(frame) - film_time(k);
        if (age >= label_duration) break;
        if (event[k] && !words(*event[k]).empty())
            return Label{words(*event[k]),
                         std::min(1.0, (label_duration - age) / std::min(label_fading, label_duration))};
    }
    return {};
}

double FilmPlan::speed(int frame) const {
    double fastest = 0, here = 0;
    const std::vector<std::pair<double, double>>& knots = map.knots();
    for (std::size_t i = 1; i < knots.size(); ++i) {
        const double film = knots[i].first - knots[i - 1].first;
        if (film <= 0) continue;
        const double slope = (knots[i].second - knots[i - 1].second) / film;
        fastest = std::max(fastest, slope);
        if (film_time(frame) >= knots[i - 1].first) here = slope;
    }
    return fastest > 0 ? here / fastest : 1;
}

double FilmPlan::freshness(double film_time, double broken_at) const {
    return std::clamp(1 - (film_time - map.film(broken_at)) / flash, 0.0, 1.0);
}

double FilmPlan::smallest_step() const {
    double smallest = 0;
    for (std::size_t k = 1; k < time.size(); ++k) {
        const double step = time[k] - time[k - 1];
        if (step > 1e-9 * (time.back() - time.front()))
            smallest = smallest > 0 ? std::min(smallest, step) : step;
    }
    return smallest;
}

}  // namespace hibi
