#include "pictures/picture.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <system_error>

#include "pictures/drawing_origin.hpp"
#include "results/neighbour_bonds.hpp"

namespace hibi {

std::vector<int> drawn_bonds(const Topology& topology, const std::string& which) {
    std::vector<int> drawn;
    if (which == "none") return drawn;
    const double longest = longest_neighbour_bond(topology);
    for (int b = 0; b < static_cast<int>(topology.first.size()); ++b)
        if (which == "all" || topology.rest_length[b] <= longest * topology.spacing[topology.first[b]])
            drawn.push_back(b);
    return drawn;
}

PictureSource::PictureSource(const RunReader& run, const View& view, const std::array<double, 2>& range,
                             const Vec3& origin, StageTimes* profile)
    : run_(run), view_(view), range_(range), topology_(topology_from(origin, run)), profile_(profile) {
    for (int b = 0; b < static_cast<int>(run.broken_at().size()); ++b)
        if (std::isfinite(run.broken_at()[b])) by_time_of_break_.push_back(b);
    // Fresh cracks are drawn over old ones.
    std::ranges::stable_sort(by_time_of_break_, {}, [&](int b) { return run.broken_at()[b]; });
}

PictureSource::Between PictureSource::between(double time) const {
    const std::vector<StateInfo>& states = run_.states();
    const auto after = std::ranges::upper_bound(states, time, {}, &StateInfo::time) - states.begin();
    const int last = static_cast<int>(states.size()) - 1;
    const int before = std::clamp(static_cast<int>(after) - 1, 0, last), next = std::min(before + 1, last);
    const double span = states[next].time - states[before].time;
    const double share = span > 0 ? std::clamp((time - states[before].time) / span, 0.0, 1.0) : 0;
    return {before, share > 0 ? next : before, share};
}

PictureSource::Loaded PictureSource::read(int state) const {
    const TimedStage timed(profile_, "read states");
    const Snapshot snapshot = run_.read(state, {"displacement", scalar_field_source(view_.field)});
    Loaded loaded{.value = scalar_field(run_.topology(), snapshot, view_.field)};
    loaded.x.reserve(snapshot.displacement.size());
    loaded.y.reserve(snapshot.displacement.size());
    for (const Vec3& u : snapshot.displacement) {
        loaded.x.push_back(u.x());
        loaded.y.push_back(u.y());
    }
    return loaded;
}

void PictureSource::expect(double time) {
    if (coming_.valid()) return;
    const Between wanted = between(time);
    std::vector<int> missing;
    for (const int state : {wanted.before, wanted.after})
        if (!loaded_.contains(state)) missing.push_back(state);
    if (missing.empty()) return;
    const auto read_them = [this, missing] {
        States states;
        for (const int state : missing)
            if (!states.contains(state)) states[state] = read(state);
        return states;
    };
    try {
        coming_ = std::async(std::launch::async, read_them);
    } catch (const std::system_error&) {  // no thread to be had: they are read when they are needed
    }
}

void PictureSource::load(const Between& wanted) {
    if (coming_.valid()) {
        const TimedStage timed(profile_, "wait for states");
        try {
            loaded_.merge(coming_.get());
        } catch (const std::runtime_error&) {  // what is needed of it fails again below
        }
    }
    for (const int state : {wanted.before, wanted.after})
        if (!loaded_.contains(state)) loaded_[state] = read(state);
    std::erase_if(loaded_, [&](const auto& entry) {
        return entry.first != wanted.before && entry.first != wanted.after;
    });
}

Picture2& PictureSource::at(double time, bool with_intact) {
    const Between wanted = between(time);
    load(wanted);
    const Loaded &a = loaded_.at(wanted.before), &b = loaded_.at(wanted.after);
    const TimedStage timed(profile_, "interpolate");
    interpolate(a, b, wanted.share);
    sort_bonds(time, with_intact);
    picture_.freshness.assign(picture_.broken.size(), 0);
    picture_.history.clear();
    return picture_;
}

void PictureSource::interpolate(const Loaded& a, const Loaded& b, double share) {
    const std::vector<Vec3>& X = topology_.reference_position;
    const std::size_t count = X.size();
    const double width = range_[1] - range_[0];
    x_.resize(count), y_.resize(count);
    picture_.x.resize(count), picture_.y.resize(count), picture_.value.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        x_[i] = X[i].x() + view_.magnify * (a.x[i] + share * (b.x[i] - a.x[i]));
        y_[i] = X[i].y() + view_.magnify * (a.y[i] + share * (b.y[i] - a.y[i]));
        picture_.x[i] = static_cast<float>(x_[i]);
        picture_.y[i] = static_cast<float>(y_[i]);
        const double value = a.value[i] + share * (b.value[i] - a.value[i]);
        const double place = (value - range_[0]) / width;
        picture_.value[i] = std::isfinite(place) ? static_cast<float>(std::clamp(place, 0.0, 1.0)) : 0.0f;
    }
}

/// Which are broken then. Most pictures show the same bonds as the one before.
void PictureSource::sort_bonds(double time, bool with_intact) {
    const std::vector<double>& broken_at = run_.broken_at();
    const auto first_intact =
        std::ranges::upper_bound(by_time_of_break_, time, {}, [&](int b) { return broken_at[b]; });
    picture_.broken.assign(by_time_of_break_.begin(), first_intact);
    if (!with_intact) {
        picture_.intact.clear();
        intact_at_.reset();
    } else if (intact_at_ != picture_.broken.size()) {
        if (!intact_candidates_) intact_candidates_ = drawn_bonds(run_.topology(), view_.bonds);
        picture_.intact.clear();
        for (const int bond : *intact_candidates_)
            if (broken_at[bond] > time) picture_.intact.push_back(bond);
        intact_at_ = picture_.broken.size();
    }
}

}  // namespace hibi
