#include "model/model.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "model/matter.hpp"

namespace hibi {

namespace {

double cross(const Vec<2>& a, const Vec<2>& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Do the closed segments ab and cd meet? Touching counts, to within `tolerance` (m): a notch drawn along a
/// row of particles must not depend on rounding.
bool segments_meet(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& d, double tolerance) {
    const Vec<2> ab = b - a, cd = d - c, ac = c - a;
    // Most are far apart.
    if ((a.cwiseMax(b).array() < c.cwiseMin(d).array() - tolerance).any() ||
        (c.cwiseMax(d).array() < a.cwiseMin(b).array() - tolerance).any())
        return false;
    const double turn = cross(ab, cd);
    if (std::abs(turn) > 1e-12 * ab.norm() * cd.norm()) {
        const double s = cross(ac, cd) / turn, t = cross(ac, ab) / turn;  // a + s ab = c + t cd
        const double slack_s = tolerance / ab.norm(), slack_t = tolerance / cd.norm();
        return s >= -slack_s && s <= 1 + slack_s && t >= -slack_t && t <= 1 + slack_t;
    }
    if (std::abs(cross(ac, ab)) > tolerance * ab.norm()) return false;  // parallel and apart
    const double length = ab.squaredNorm();
    const double s0 = ac.dot(ab) / length, s1 = (d - a).dot(ab) / length;
    const double slack = tolerance / ab.norm();
    return std::max(s0, s1) >= -slack && std::min(s0, s1) <= 1 + slack;
}

bool crosses(const Notch<2>& notch, const Vec<2>& a, const Vec<2>& b, double tolerance) {
    for (std::size_t k = 1; k < notch.points.size(); ++k)
        if (segments_meet(a, b, notch.points[k - 1], notch.points[k], tolerance)) return true;
    return false;
}

/// Sorts bond vectors into kinds.
class BondKinds {
 public:
    explicit BondKinds(BondVectors<2>& vectors) : vectors_(vectors) {}

    /// The kind of a bond with this r0 in lattices of spacing l0.
    int find(const Vec<2>& r0, double l0) {
        const Vec<2> ratio = r0 / l0;
        const Key key{std::llround(cells * ratio.x()), std::llround(cells * ratio.y()), l0};
        if (key == last_) return last_kind_;
        const auto [at, is_new] = known_.try_emplace(key, static_cast<int>(vectors_.table.size()));
        if (is_new) {
            // Of an unturned lattice the whole multiples are known to the last bit.
            const Vec<2> whole = ratio.array().round();
            add((ratio - whole).cwiseAbs().maxCoeff() < rounding ? Vec<2>(l0 * whole) : r0);
        }
        last_ = key;
        return last_kind_ = at->second;
    }

    /// A kind of its own, for a bond like no other.
    int add(const Vec<2>& r0) {
        vectors_.table.push_back(r0);
        return static_cast<int>(vectors_.table.size()) - 1;
    }

 private:
    struct Key {
        long long x = 0, y = 0;  ///< r0 / l0 in cells
        double l0 = 0;
        auto operator<=>(const Key&) const = default;
    };
    static constexpr double cells = 1 << 20, rounding = 1e-9;

    BondVectors<2>& vectors_;
    std::map<Key, int> known_;
    Key last_;
    int last_kind_ = -1;
};

/// Of the centres that would fill a body, those on its sides where an earlier body has a particle on a side
/// of its own: two bodies with a common side through the centres of one lattice share it.
template <int Dim>
std::vector<char> taken(const Model<Dim>& model, const Body<Dim>& body,
                        const std::vector<Vec<Dim>>& centres) {
    const double slack = slack_per_spacing * body.spacing;
    const auto on_side = [&](const Body<Dim>& of, const Vec<Dim>& X) {
        return std::abs(depth(of.shape, X)) <= slack;
    };
    std::vector<char> result(centres.size(), 0);
    if (model.bodies.empty()) return result;
    std::vector<std::size_t> candidates;
    for (std::size_t k = 0; k < centres.size(); ++k)
        if (on_side(body, centres[k])) candidates.push_back(k);
    if (candidates.empty()) return result;
    for (const Body<Dim>& earlier : model.bodies)
        for (int i = earlier.begin; i < earlier.end; ++i) {
            const Vec<Dim>& X = model.cell_centre(i);
            if (!on_side(body, X) || !on_side(earlier, X)) continue;
            for (const std::size_t k : candidates)
                if ((centres[k] - X).norm() <= 2 * slack) result[k] = 1;
        }
    return result;
}

}  // namespace

template <int Dim>
void add_body(Model<Dim>& model, Body<Dim> body) {
    std::vector<Vec<Dim>> points = fill(body.shape, body.spacing, body.lattice);
    Lattice undisturbed = body.lattice;
    undisturbed.jitter = 0;
    std::vector<Vec<Dim>> centres =
        body.lattice.jitter == 0 ? points : fill(body.shape, body.spacing, undisturbed);
    const std::vector<char> is_taken = taken(model, body, centres);
    const auto leave_out = [&](std::vector<Vec<Dim>>& list) {
        std::size_t k = 0;
        std::erase_if(list, [&](const Vec<Dim>&) { return is_taken[k++] != 0; });
    };
    leave_out(points);
    leave_out(centres);
    if (body.lattice.jitter > 0) body.undisturbed = std::move(centres);
    Particles<Dim>& particles = model.particles;
    body.begin = particles.count();
    body.end = body.begin + static_cast<int>(points.size());
    const double volume = std::pow(body.spacing, Dim) * (Dim == 2 ? model.thickness : 1.0);
    Particles<Dim>::each_field(particles, [&](const char*, auto& field) {
        using Value = typename std::remove_reference_t<decltype(field)>::value_type;
        if constexpr (std::is_arithmetic_v<Value>)
            field.resize(body.end, Value{});
        else
            field.resize(body.end, Value::Zero());
    });
    for (int i = body.begin; i < body.end; ++i) {
        particles.reference_position[i] = points[i - body.begin];
        particles.volume[i] = volume;
        particles.mass[i] = model.materials[body.material].density * volume;
        particles.spacing[i] = body.spacing;
        particles.material[i] = body.material;
        particles.body[i] = static_cast<int>(model.bodies.size());
    }
    model.bodies.push_back(std::move(body));
}

template <int Dim>
std::vector<int> connect(Model<Dim>& model, const std::vector<Notch<Dim>>& notches) {
    const Particles<Dim>& particles = model.particles;
    const std::vector<Vec<Dim>>& X = particles.reference_position;

    // Bodies joined to each other are searched together, all others alone: they may differ in spacing.
    std::vector<int> group(model.bodies.size());
    for (std::size_t b = 0; b < group.size(); ++b) {
        group[b] = static_cast<int>(b);
        for (const int other : model.bodies[b].bonded_to) {
            const int merged = group[other], own = group[b];
            for (std::size_t k = 0; k <= b; ++k)
                if (group[k] == own) group[k] = merged;
        }
    }
    const auto joined = [&](int a, int b) {
        if (a == b) return true;
        const std::vector<int>& list = model.bodies[std::max(a, b)].bonded_to;
        return std::find(list.begin(), list.end(), std::min(a, b)) != list.end();
    };

    std::vector<int> cut(notches.size(), 0);
    std::vector<std::pair<int, int>> pairs;
    model.bonds_cut = model.bonds_over_gaps = 0;
    for (std::size_t g = 0; g < group.size(); ++g) {
        std::vector<int> members;
        for (int i = 0; i < particles.count(); ++i)
            if (group[particles.body[i]] == static_cast<int>(g)) members.push_back(i);
        if (members.empty()) continue;
        std::vector<Vec<Dim>> points;
        points.reserve(members.size());
        for (const int i : members) points.push_back(X[i]);
        std::vector<int> bodies;
        for (std::size_t b = 0; b < group.size(); ++b)
            if (group[b] == static_cast<int>(g)) bodies.push_back(static_cast<int>(b));
        const Matter<Dim> matter(model, bodies);
        const double spacing = particles.spacing[members.front()], slack = slack_per_spacing * spacing;
        for (const auto& [a, b] : neighbours(points, model.influence * spacing)) {
            const int i = members[a], j = members[b];
            if (!joined(particles.body[i], particles.body[j])) continue;
            bool is_cut = false;
            for (std::size_t k = 0; k < notches.size(); ++k) {
                const int only = notches[k].body;
                if (only >= 0 && only != particles.body[i] && only != particles.body[j]) continue;
                if (crosses(notches[k], X[i], X[j], slack)) {
                    ++cut[k];
                    is_cut = true;
                }
            }
            if (is_cut)
                ++model.bonds_cut;
            else if (!matter.joins(i, j))
                ++model.bonds_over_gaps;
            else
                pairs.push_back({i, j});
        }
    }
    std::sort(pairs.begin(), pairs.end());

    Bonds& bonds = model.bonds;
    bonds = {};
    model.bond_vectors = {};
    BondKinds kinds(model.bond_vectors);
    for (std::vector<int>* field : {&bonds.first, &bonds.second, &model.bond_vectors.kind})
        field->reserve(pairs.size());
    bonds.rest_length.reserve(pairs.size());
    for (const auto& [i, j] : pairs) {
        bonds.first.push_back(i);
        bonds.second.push_back(j);
        const bool irregular = model.bodies[particles.body[i]].lattice.jitter > 0 ||
                               model.bodies[particles.body[j]].lattice.jitter > 0;
        model.bond_vectors.kind.push_back(irregular ? kinds.add(X[j] - X[i])
                                                    : kinds.find(X[j] - X[i], particles.spacing[i]));
        bonds.rest_length.push_back(model.bond_vectors[bonds.count() - 1].norm());
    }
    index_bonds(bonds, particles.count());
    return cut;
}

template void add_body<2>(Model<2>&, Body<2>);
template std::vector<int> connect<2>(Model<2>&, const std::vector<Notch<2>>&);

}  // namespace hibi
