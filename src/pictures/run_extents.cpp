#include "pictures/run_extents.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pictures/drawing_origin.hpp"

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

namespace {

/// Particles in pieces, each a ring through `next` with its size at its root: joining two takes no time.
struct Pieces {
    std::vector<int> root, next, size;

    explicit Pieces(int count) : root(count), next(count), size(count, 1) {
        for (int i = 0; i < count; ++i) root[i] = next[i] = i;
    }
    int of(int i) {
        while (root[i] != i) i = root[i] = root[root[i]];
        return i;
    }
    void join(int p, int q) {
        if (size[p] < size[q]) std::swap(p, q);
        root[q] = p;
        size[p] += size[q];
        std::swap(next[p], next[q]);
    }
    template <class Visit>
    void each_of(int p, Visit&& visit) const {
        int i = p;
        do visit(i);
        while ((i = next[i]) != p);
    }
};

std::vector<double> find_detached(const RunReader& run) {
    constexpr double never = std::numeric_limits<double>::infinity();
    const Topology& topology = run.topology();
    const int count = static_cast<int>(topology.spacing.size());
    std::vector<double> loose(count, never);
    std::vector<int> broken;
    for (int b = 0; b < static_cast<int>(topology.first.size()); ++b)
        if (run.broken_at()[b] != never) broken.push_back(b);
    if (broken.empty()) return loose;

    // From the end backwards, every broken bond joins two pieces again.
    const double least = least_piece * count;
    Pieces pieces(count);
    for (int b = 0; b < static_cast<int>(topology.first.size()); ++b) {
        if (run.broken_at()[b] != never) continue;
        const int p = pieces.of(topology.first[b]), q = pieces.of(topology.second[b]);
        if (p != q) pieces.join(p, q);
    }
    std::ranges::sort(broken, std::greater{}, [&](int b) { return run.broken_at()[b]; });
    for (const int b : broken) {
        const int p = pieces.of(topology.first[b]), q = pieces.of(topology.second[b]);
        if (p == q) continue;
        if (pieces.size[p] + pieces.size[q] >= least)
            for (const int piece : {p, q})
                if (pieces.size[piece] < least)
                    pieces.each_of(piece, [&](int i) { loose[i] = run.broken_at()[b]; });
        pieces.join(p, q);
    }
    return loose;
}

std::array<double, 4> find_window(const RunReader& run, const View& view, const Vec3& origin) {
    constexpr double far = std::numeric_limits<double>::infinity();
    std::array<double, 4> box{far, far, -far, -far};
    const Topology& topology = topology_from(origin, run);
    for (const Vec3& X : topology.reference_position) include(box, X.x(), X.y());
    const std::array<double, 4> at_rest = box;
    // Reading every state takes longer than drawing it: where their extents are no help, some are enough.
    constexpr int most_read = 48;
    const int last = last_counting_state(run);
    const double end = run.states()[last].time;
    const std::vector<double>& loose = detached_at(run);
    const bool extents_do =
        view.magnify == 1 && std::ranges::none_of(loose, [&](double since) { return since <= end; });
    const int stride = extents_do ? 1 : std::max(1, last / most_read);
    // An extent is counted from the origin of the scene: far from there it is not exact enough.
    const bool read_extents = extents_do && origin == Vec3::Zero();
    for (int s = last; view.magnify != 0 && s >= 0; s -= stride) {
        if (read_extents) {
            const RunReader::Extent extent = run.extent(s);
            include(box, extent.low.x(), extent.low.y());
            include(box, extent.high.x(), extent.high.y());
            continue;
        }
        const Snapshot snapshot = run.read(s, {"displacement"});
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

/// With repetitions where a particle is both held and loaded.
std::vector<int> held_or_loaded(const Topology& topology) {
    std::vector<int> marked;
    for (const Support& s : topology.supports)
        marked.insert(marked.end(), s.particles.begin(), s.particles.end());
    for (const LoadMark& l : topology.loads)
        marked.insert(marked.end(), l.particles.begin(), l.particles.end());
    return marked;
}

}  // namespace

const std::vector<double>& detached_at(const RunReader& run) {
    return run.once<std::vector<double>>("detached_at", [&] { return find_detached(run); });
}

std::array<double, 4> body_window(const RunReader& run, const View& view, const Vec3& origin) {
    return run.once<std::array<double, 4>>(
        fmt::format("body_window {} {} {}", view.magnify, origin.x(), origin.y()),
        [&] { return find_window(run, view, origin); });
}

const std::vector<std::pair<int, Vec3>>& anchor_displacements(const RunReader& run, int state) {
    using Places = std::vector<std::pair<int, Vec3>>;
    return run.once<Places>(fmt::format("anchor_displacements {}", state), [&] {
        const std::vector<Vec3> u = run.read(state, {"displacement"}).displacement;
        Places places;
        for (const int i : held_or_loaded(run.topology())) places.emplace_back(i, u[i]);
        return places;
    });
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
