#include "app/picture.hpp"

#include <algorithm>
#include <cmath>

#include "measure/neighbour_bonds.hpp"

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

PictureSource::PictureSource(const RunReader& run, const View& view, const std::array<double, 2>& range)
    : run_(run), view_(view), range_(range), intact_candidates_(drawn_bonds(run.topology(), view.bonds)) {
    for (int b = 0; b < static_cast<int>(run.broken_at().size()); ++b)
        if (std::isfinite(run.broken_at()[b])) by_time_of_break_.push_back(b);
    // Fresh cracks are drawn over old ones.
    std::ranges::stable_sort(by_time_of_break_, {}, [&](int b) { return run.broken_at()[b]; });
}

/// The state, read unless it is one of the two at hand; the one with number `keep` is not given up for it.
const PictureSource::Loaded& PictureSource::load(int state, int keep) {
    for (const Loaded& l : loaded_)
        if (l.state == state) return l;
    Loaded& free = loaded_[loaded_[0].state == keep ? 1 : 0];
    const Snapshot snapshot = run_.read(state);
    free.value = scalar_field(run_.topology(), snapshot, view_.field);
    free.displacement = snapshot.displacement;
    free.state = state;
    return free;
}

Picture2 PictureSource::at(double time) {
    const std::vector<StateInfo>& states = run_.states();
    const auto after = std::ranges::upper_bound(states, time, {}, &StateInfo::time) - states.begin();
    const int last = static_cast<int>(states.size()) - 1;
    const int before = std::clamp(static_cast<int>(after) - 1, 0, last), next = std::min(before + 1, last);
    const double span = states[next].time - states[before].time;
    const double share = span > 0 ? std::clamp((time - states[before].time) / span, 0.0, 1.0) : 0;
    const Loaded& a = load(before, next);
    const Loaded& b = share > 0 ? load(next, before) : a;

    Picture2 picture;
    const std::vector<Vec3>& X = run_.topology().reference_position;
    const std::size_t count = X.size();
    x_.resize(count), y_.resize(count);
    picture.x.resize(count), picture.y.resize(count), picture.value.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 u = a.displacement[i] + share * (b.displacement[i] - a.displacement[i]);
        x_[i] = X[i].x() + view_.magnify * u.x();
        y_[i] = X[i].y() + view_.magnify * u.y();
        picture.x[i] = static_cast<float>(x_[i]);
        picture.y[i] = static_cast<float>(y_[i]);
        const double value = a.value[i] + share * (b.value[i] - a.value[i]);
        const double place = (value - range_[0]) / (range_[1] - range_[0]);
        picture.value[i] = std::isfinite(place) ? static_cast<float>(std::clamp(place, 0.0, 1.0)) : 0.0f;
    }
    for (const int bond : intact_candidates_)
        if (run_.broken_at()[bond] > time) picture.intact.push_back(bond);
    for (const int bond : by_time_of_break_)
        if (run_.broken_at()[bond] <= time) picture.broken.push_back(bond);
    picture.freshness.resize(picture.broken.size());
    return picture;
}

}  // namespace hibi
