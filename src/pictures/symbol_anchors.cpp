#include "pictures/symbol_anchors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "pictures/picture.hpp"

namespace hibi {

namespace {

constexpr double window_margin = 0.03;  // of the larger side of the body's box
constexpr double arrow_distance = 34;   // between two arrows of one load, for a picture unit of 1 (pixels)

/// Unit vectors from every particle that is held or loaded to its nearest neighbours in the unloaded body.
std::vector<std::vector<Vec3>> nearest_directions(const Topology& topology) {
    std::vector<std::vector<Vec3>> directions(topology.reference_position.size());
    std::vector<char> wanted(directions.size(), 0);
    for (const Support& support : topology.supports)
        for (const int i : support.particles) wanted[i] = 1;
    for (const LoadMark& load : topology.loads)
        for (const int i : load.particles) wanted[i] = 1;
    for (const int b : drawn_bonds(topology, "nearest")) {
        const int i = topology.first[b], j = topology.second[b];
        if (!wanted[i] && !wanted[j]) continue;
        const Vec3 d = (topology.reference_position[j] - topology.reference_position[i]).normalized();
        if (wanted[i]) directions[i].push_back(d);
        if (wanted[j]) directions[j].push_back(-d);
    }
    return directions;
}

/// In slices one particle wide across `towards`: the particle of each that lies farthest that way. In order.
std::vector<int> foremost(const Topology& topology, const std::vector<int>& particles, const Vec3& towards) {
    const Vec3 across(-towards.y(), towards.x(), 0);
    std::map<long, int> slices;
    // Counted from a particle: centres lie half way between the multiples of the spacing, where rounding
    // decides.
    const Vec3 origin = topology.reference_position[particles.front()];
    for (const int i : particles) {
        const Vec3& X = topology.reference_position[i];
        const auto [slot, is_new] =
            slices.try_emplace(std::lround((X - origin).dot(across) / topology.spacing[i]), i);
        if (!is_new && X.dot(towards) > topology.reference_position[slot->second].dot(towards))
            slot->second = i;
    }
    std::vector<int> result;
    for (const auto& [slice, particle] : slices) result.push_back(particle);
    return result;
}

/// Cut wherever the next particle is no neighbour any more.
std::vector<std::vector<int>> stretches(const Topology& topology, const std::vector<int>& line) {
    std::vector<std::vector<int>> parts;
    for (std::size_t k = 0; k < line.size(); ++k) {
        const auto& X = topology.reference_position;
        if (k == 0 || (X[line[k]] - X[line[k - 1]]).norm() > 2.1 * topology.spacing[line[k]])
            parts.emplace_back();
        parts.back().push_back(line[k]);
    }
    return parts;
}

/// Where the particles' neighbours are missing, on the whole; straight down where none or all are.
Vec3 away_from_body(const std::vector<int>& particles, const std::vector<std::vector<Vec3>>& neighbours,
                    const std::array<bool, 3>& axes) {
    Vec3 sum = Vec3::Zero();
    for (const int i : particles)
        for (const Vec3& d : neighbours[i]) sum -= d;
    const double scale = std::max<double>(1, static_cast<double>(particles.size()));
    if (axes[0] != axes[1]) {  // a roller stands square to the one way it holds
        const int held = axes[0] ? 0 : 1;
        Vec3 out = Vec3::Zero();
        out[held] = sum[held] > 0.1 * scale ? 1 : -1;
        return out;
    }
    if (sum.norm() < 0.05 * scale) return -Vec3::UnitY();
    sum.normalize();
    for (int a = 0; a < 2; ++a)
        if (std::abs(sum[a]) > 0.97) return std::copysign(1.0, sum[a]) * Vec3::Unit(a);
    return sum;
}

/// Is the body itself in the way of what comes from `side`? Asked of most of the line's particles.
bool covered(const std::vector<int>& line, const std::vector<std::vector<Vec3>>& neighbours,
             const Vec3& side) {
    const auto count = std::ranges::count_if(line, [&](int i) {
        return std::ranges::any_of(neighbours[i], [&](const Vec3& d) { return d.dot(side) > 0.7; });
    });
    return 2 * count > static_cast<long>(line.size());
}

std::array<double, 2> flat(const Vec3& v) { return {v.x(), v.y()}; }

}  // namespace

std::vector<SymbolAnchor> find_symbol_anchors(const Topology& topology, bool supports, bool loads) {
    std::vector<SymbolAnchor> anchors;
    const auto neighbours = nearest_directions(topology);
    const auto radius = [&](const std::vector<int>& line) { return topology.spacing[line.front()] / 2; };
    for (const Support& support : topology.supports) {
        if (!supports || support.particles.empty() || !(support.axes[0] || support.axes[1])) continue;
        const Vec3 out = away_from_body(support.particles, neighbours, support.axes);
        const bool both = support.axes[0] && support.axes[1];
        for (const std::vector<int>& line : stretches(topology, foremost(topology, support.particles, out)))
            anchors.push_back({.kind = both ? Symbol::Kind::clamp : Symbol::Kind::roller,
                               .particles = line,
                               .radius = radius(line),
                               .towards = flat(out)});
    }
    for (int k = 0; k < static_cast<int>(topology.loads.size()); ++k) {
        const LoadMark& load = topology.loads[k];
        if (!loads || load.particles.empty()) continue;
        std::vector<int> line = foremost(topology, load.particles, -load.direction);
        const std::vector<int> behind = foremost(topology, load.particles, load.direction);
        const bool pulls =
            covered(line, neighbours, -load.direction) && !covered(behind, neighbours, load.direction);
        if (pulls) line = behind;
        for (const std::vector<int>& part : stretches(topology, line))
            anchors.push_back({.kind = Symbol::Kind::arrow,
                               .particles = part,
                               .radius = radius(part),
                               .towards = flat(load.direction),
                               .pulls = pulls,
                               .load = k});
    }
    return anchors;
}

Symbol place_symbol(const SymbolAnchor& anchor, std::span<const double> x, std::span<const double> y,
                    const Camera2& camera, double size, double unit) {
    Symbol symbol;
    symbol.kind = anchor.kind;
    symbol.radius = anchor.radius * camera.scale;
    for (const int i : anchor.particles)
        symbol.points.push_back({camera.pixel_x(x[i]), camera.pixel_y(y[i])});
    const std::array<double, 2> towards = {anchor.towards[0], -anchor.towards[1]};
    if (anchor.kind != Symbol::Kind::arrow) {
        symbol.outward = towards;
        return symbol;
    }
    const double sign = size < 0 ? -1 : 1;
    symbol.direction = {sign * towards[0], sign * towards[1]};
    symbol.pulls = anchor.pulls != (size < 0);
    symbol.size = std::abs(size);
    const int last = static_cast<int>(symbol.points.size()) - 1;
    const double length =
        2 * anchor.radius * camera.scale * last;  // in the unloaded body: the number never changes
    const int gaps = std::min(last, std::max(1, static_cast<int>(length / (arrow_distance * unit))));
    if (last > 0) {
        std::vector<std::array<double, 2>> chosen;  // evenly spread, also between particles
        for (int k = 0; k <= gaps; ++k) {
            const double at = static_cast<double>(k) * last / gaps;
            const int i = std::min(static_cast<int>(at), last - 1);
            const std::array<double, 2>&a = symbol.points[i], &b = symbol.points[i + 1];
            chosen.push_back({a[0] + (at - i) * (b[0] - a[0]), a[1] + (at - i) * (b[1] - a[1])});
        }
        symbol.points = chosen;
    }
    return symbol;
}

std::vector<Reserved> reserve(const SymbolAnchor& anchor, std::span<const double> x,
                              std::span<const double> y, double size, const View& view) {
    const bool arrow = anchor.kind == Symbol::Kind::arrow;
    const double reach = symbol_reach(anchor.kind, view) * (arrow ? std::min(std::abs(size), 1.0) : 1);
    const double sign =
        arrow && !anchor.pulls ? -1 : 1;  // a load that turns round stays on its side of the body
    const double dx = sign * anchor.towards[0] * reach, dy = sign * anchor.towards[1] * reach;
    std::vector<Reserved> reserved;
    for (const int i : anchor.particles)
        reserved.push_back({x[i] + std::copysign(anchor.radius, dx),
                            y[i] + std::copysign(anchor.radius, dy),
                            {std::max(0.0, -dx), std::max(0.0, dy), std::max(0.0, dx), std::max(0.0, -dy)}});
    return reserved;
}

Camera2 camera_for(const std::array<double, 4>& window, std::span<const Reserved> reserved,
                   const PixelRect& plot) {
    const double margin = window_margin * std::max(window[2] - window[0], window[3] - window[1]);
    std::vector<Reserved> all = {{window[0] - margin, window[1] - margin},
                                 {window[2] + margin, window[3] + margin}};
    for (Reserved r : reserved) {
        if (!std::isfinite(r.x) || !std::isfinite(r.y)) continue;
        for (int side = 0; side < 4; ++side)  // small pictures: the body goes before the symbols
            r.room[side] = std::min(r.room[side], 0.25 * (side % 2 == 0 ? plot.width : plot.height));
        all.push_back(r);
    }
    // Box around everything, in pixels from the origin of the world, for a number of pixels per metre.
    const auto box = [&](double scale) {
        constexpr double far = std::numeric_limits<double>::infinity();
        std::array<double, 4> b{far, far, -far, -far};  // left, top, right, bottom
        for (const Reserved& r : all)
            b = {std::min(b[0], r.x * scale - r.room[0]), std::min(b[1], -r.y * scale - r.room[1]),
                 std::max(b[2], r.x * scale + r.room[2]), std::max(b[3], -r.y * scale + r.room[3])};
        return b;
    };
    const auto fits = [&](double scale) {
        const std::array<double, 4> b = box(scale);
        return b[2] - b[0] <= plot.width * (1 + 1e-9) && b[3] - b[1] <= plot.height * (1 + 1e-9);
    };
    double good = 0, scale = Camera2::fit(all[0].x, all[0].y, all[1].x, all[1].y, plot).scale;
    if (!fits(scale)) {  // halve the interval between a scale that fits and one that does not
        double bad = scale;
        for (int k = 0; k < 40; ++k) (fits((good + bad) / 2) ? good : bad) = (good + bad) / 2;
        scale = good;
    }
    const std::array<double, 4> b = box(scale);
    return {scale, (b[0] + b[2]) / 2 / scale, -(b[1] + b[3]) / 2 / scale, plot};
}

}  // namespace hibi
