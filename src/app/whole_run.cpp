#include "app/whole_run.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hibi {

namespace {

double largest_spacing(const Topology& topology) {
    return topology.spacing.empty() ? 0 : *std::ranges::max_element(topology.spacing);
}

/// Grows the box [low, high] by a point if that is finite.
void include(std::array<double, 4>& box, double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    box = {std::min(box[0], x), std::min(box[1], y), std::max(box[2], x), std::max(box[3], y)};
}

/// The next round number away from zero, so that colour bars end on one and similar runs share a range.
double rounded_up(double v) {
    if (v == 0) return 0;
    const double power = std::pow(10, std::floor(std::log10(std::abs(v))));
    for (const double round : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0})
        if (std::abs(v) <= round * power * (1 + 1e-9)) return std::copysign(round * power, v);
    return v;
}

/// Pieces of less than this share of the particles fly off without the picture following them.
constexpr double least_piece = 0.02;

}  // namespace

int last_counting_state(const RunReader& run) {
    const int last = static_cast<int>(run.states().size()) - 1;
    const std::optional<Event>& separation = run.summary().events.separation;
    if (!separation) return last;
    for (int s = 0; s < last; ++s)
        if (run.states()[s].time >= separation->time) return s;
    return last;
}

std::vector<double> loose_since(const RunReader& run) {
    // From the end backwards, every broken bond joins two pieces again.
    const Topology& topology = run.topology();
    const int count = static_cast<int>(topology.spacing.size());
    const double least = least_piece * count;
    constexpr double never = std::numeric_limits<double>::infinity(), small_at_the_end = -1;
    std::vector<double> loose(count, never);
    std::vector<int> piece(count);
    std::vector<std::vector<int>> members(count);
    for (int i = 0; i < count; ++i) piece[i] = i, members[i] = {i};
    const auto small = [&](int p) { return static_cast<double>(members[p].size()) < least; };
    const auto join = [&](int bond, double time) {
        int p = piece[topology.first[bond]], q = piece[topology.second[bond]];
        if (p == q) return;
        if (members[p].size() < members[q].size()) std::swap(p, q);
        const std::size_t before = members[p].size();
        const bool was_small = small(p), other_small = small(q);
        for (const int i : members[q]) piece[i] = p;
        members[p].insert(members[p].end(), members[q].begin(), members[q].end());
        members[q].clear();
        if (small(p)) return;
        for (std::size_t k = was_small ? 0 : before; k < (other_small ? members[p].size() : before); ++k)
            loose[members[p][k]] = time;
    };
    std::vector<int> broken;
    for (int b = 0; b < static_cast<int>(topology.first.size()); ++b) {
        if (run.broken_at()[b] == never)
            join(b, never);
        else
            broken.push_back(b);
    }
    for (int i = 0; i < count; ++i)
        if (small(piece[i])) loose[i] = small_at_the_end;
    std::ranges::sort(broken, std::greater{}, [&](int b) { return run.broken_at()[b]; });
    for (const int b : broken) join(b, run.broken_at()[b]);
    std::ranges::replace(loose, small_at_the_end, never);  // it was small before the run, too
    return loose;
}

std::array<double, 4> body_window(const RunReader& run, const View& view) {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 4> box{far, far, -far, -far};
    const Topology& topology = run.topology();
    for (const Vec3& X : topology.reference_position) include(box, X.x(), X.y());
    const std::array<double, 4> at_rest = box;
    // Reading every state takes longer than drawing it: where their extents are no help, some are enough.
    constexpr int most_read = 48;
    const int last = last_counting_state(run);
    const double end = run.states()[last].time;
    const std::vector<double> loose = loose_since(run);
    const bool extents_do =
        view.magnify == 1 && std::ranges::none_of(loose, [&](double since) { return since <= end; });
    const int stride = extents_do ? 1 : std::max(1, last / most_read);
    for (int s = last; view.magnify != 0 && s >= 0; s -= stride) {
        if (extents_do) {
            const RunReader::Extent extent = run.extent(s);
            include(box, extent.low.x(), extent.low.y());
            include(box, extent.high.x(), extent.high.y());
            continue;
        }
        const Snapshot snapshot = run.read(s);
        for (int i = 0; i < snapshot.count(); ++i) {
            if (snapshot.time >= loose[i]) continue;
            const Vec3 p = topology.reference_position[i] + view.magnify * snapshot.displacement[i];
            include(box, p.x(), p.y());
        }
    }
    if (view.magnify > 1) {
        // What moves far, drawn many times as far, would leave the rest a speck.
        const double reach = 3 * std::max(at_rest[2] - at_rest[0], at_rest[3] - at_rest[1]);
        for (int side = 0; side < 4; ++side)
            box[side] = std::clamp(box[side], at_rest[side] - reach, at_rest[side] + reach);
    }
    const double radius = largest_spacing(topology) / 2;
    return {box[0] - radius, box[1] - radius, box[2] + radius, box[3] + radius};
}

std::array<double, 2> colour_range(const RunReader& run, const std::string& field, bool symmetric) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int s = 0; s <= last_counting_state(run); ++s) {
        const RunReader::Extent extent = run.extent(s);
        const auto found = extent.range.find(field);
        if (found == extent.range.end()) continue;
        for (const double v : found->second)
            if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
    }
    if (!(low <= high)) low = high = 0;
    low = rounded_up(low);
    high = rounded_up(high);
    if (symmetric) {
        high = std::max(std::abs(low), std::abs(high));
        low = -high;
    } else {
        low = std::min(low, 0.0);
        high = std::max(high, 0.0);
        // A hundredth of the other side is not worth showing.
        if (-low < 0.01 * high) low = 0;
        if (high < -0.01 * low) high = 0;
    }
    if (high <= low) high = low + 1;
    return {low, high};
}

}  // namespace hibi
