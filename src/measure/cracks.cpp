#include "measure/cracks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "model/intact_bonds.hpp"

namespace hibi {

namespace {

/// Growth over which the speed is fitted, in spacings, and the least that gives a speed at all.
constexpr double speed_window = 10, least_growth = 5;

}  // namespace

CutLength::CutLength(double influence) {
    struct Direction {
        double angle = 0, weight = 0;  // weight: sum of r_e/r - 1 over its bonds
        std::vector<int> squares;
    };
    std::map<std::pair<int, int>, Direction> found;  // by the shortest vector of the direction
    const int reach = static_cast<int>(influence);
    const auto weight = [&](double r) { return influence / r - 1; };
    for (int i = -reach; i <= reach; ++i) {
        for (int j = 0; j <= reach; ++j) {
            const double r = std::hypot(i, j);
            if ((j == 0 && i <= 0) || r >= influence) continue;
            const int part = std::gcd(i, j);
            Direction& d = found[{i / part, j / part}];
            d.angle = std::atan2(j, i);
            d.weight += weight(r);
            d.squares.push_back(i * i + j * j);
        }
    }
    std::vector<Direction> directions;
    for (const auto& [vector, direction] : found) directions.push_back(direction);
    std::sort(directions.begin(), directions.end(),
              [](const Direction& a, const Direction& b) { return a.angle < b.angle; });
    const std::size_t n = directions.size();
    const auto sector = [&](std::size_t k) {
        const double before = k > 0 ? directions[k - 1].angle : directions[n - 1].angle - std::numbers::pi;
        const double after = k + 1 < n ? directions[k + 1].angle : directions[0].angle + std::numbers::pi;
        return (after - before) / 2;
    };
    double along_lattice = 0;
    for (std::size_t k = 0; k < n; ++k) along_lattice += sector(k) * std::abs(std::cos(directions[k].angle));
    for (std::size_t k = 0; k < n; ++k) {
        for (const int square : directions[k].squares) {
            const double r = std::sqrt(square);
            per_bond_[square] = sector(k) / along_lattice * weight(r) / directions[k].weight / r;
        }
    }
}

double CutLength::operator()(double rest_length, double spacing) const {
    const double square = rest_length * rest_length / (spacing * spacing);
    auto nearest = per_bond_.lower_bound(static_cast<int>(std::lround(square)));
    if (nearest == per_bond_.end()) --nearest;
    return nearest->second * spacing;
}

template <int Dim>
Cracks<Dim>::Cracks(const Model<Dim>& model) : cut_length_(model.influence), influence_(model.influence) {
    static_assert(Dim == 2, "a crack of a solid has an area");
}

template <int Dim>
int Cracks<Dim>::oldest(int crack) const {
    while (cracks_[crack].merged_into >= 0) crack = cracks_[crack].merged_into;
    return crack;
}

namespace {

template <int Dim>
Vec<Dim> middle(const Model<Dim>& model, int bond) {
    const std::vector<Vec<Dim>>& X = model.particles.reference_position;
    return (X[model.bonds.first[bond]] + X[model.bonds.second[bond]]) / 2;
}

}  // namespace

/// The crack a fresh break belongs to, begun or joined together if need be. Broken bonds nearby are found
/// along the bonds: those of the two particles and of the particles these were bonded to.
template <int Dim>
int Cracks<Dim>::crack_of(const Model<Dim>& model, int bond) {
    const Bonds& bonds = model.bonds;
    const Vec<Dim> here = middle(model, bond);
    const double spacing = model.particles.spacing[bonds.first[bond]], near = influence_ * spacing;
    std::vector<int> touched;
    for (const int i : {bonds.first[bond], bonds.second[bond]}) {
        for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
            const int j = bonds.other(bonds.bonds_of[k], i);
            for (int l = bonds.start[j]; l < bonds.start[j + 1]; ++l) {
                const int b = bonds.bonds_of[l];
                if (crack_of_[b] >= 0 && (middle(model, b) - here).norm() < near)
                    touched.push_back(oldest(crack_of_[b]));
            }
        }
    }
    if (touched.empty()) {
        cracks_.push_back({.origin = here, .tip = here, .spacing = spacing});
        return static_cast<int>(cracks_.size()) - 1;
    }
    const int first = *std::min_element(touched.begin(), touched.end());
    Crack& crack = cracks_[first];
    for (const int c : touched) {
        if (c == first || cracks_[c].merged_into >= 0) continue;
        Crack& other = cracks_[c];
        other.merged_into = first;
        const double reach = (other.tip - crack.origin).norm();
        if (reach > crack.reach) {  // a leap, which is no speed
            crack.tip = other.tip;
            crack.reach = reach;
            crack.advances.clear();
        }
    }
    return first;
}

template <int Dim>
void Cracks<Dim>::advance(Crack& crack, const Vec<Dim>& tip, double reach, double time) {
    crack.tip = tip;
    crack.reach = reach;
    std::deque<Advance>& advances = crack.advances;
    const bool same_step = !advances.empty() && advances.back().time == time;
    const std::size_t before = advances.size() - (same_step ? 1 : 0);
    // In one step a tip runs less than a spacing: this is a row of bonds that broke at once, no speed.
    if (before > 0 && reach - advances[before - 1].reach > influence_ * crack.spacing) advances.clear();
    if (same_step && !advances.empty())
        advances.back().reach = reach;
    else
        advances.push_back({time, reach});
    while (advances.front().reach < reach - (speed_window + 1e-9) * crack.spacing) advances.pop_front();
}

template <int Dim>
void Cracks<Dim>::grow(const Model<Dim>& model, std::span<const int> just_broken, double time) {
    if (just_broken.empty()) return;
    if (crack_of_.empty()) crack_of_.assign(model.bonds.count(), -1);
    for (const int b : just_broken) {
        length_ += cut_length_(model.bonds.rest_length[b], model.particles.spacing[model.bonds.first[b]]);
        const int c = crack_of(model, b);
        crack_of_[b] = c;
        Crack& crack = cracks_[c];
        const Vec<Dim> here = middle(model, b);
        const double reach = (here - crack.origin).norm();
        if (reach > crack.reach || crack.advances.empty())
            advance(crack, reach > crack.reach ? here : crack.tip, std::max(reach, crack.reach), time);
        leading_ = leading_ < 0 ? c : oldest(leading_);
        if (crack.reach > cracks_[leading_].reach + influence_ * crack.spacing) leading_ = c;
    }
    top_speed_ = std::max(top_speed_, speed(cracks_[leading_], time));
}

template <int Dim>
double Cracks<Dim>::speed(const Crack& crack, double time) const {
    const std::deque<Advance>& advances = crack.advances;
    if (advances.size() < 2) return 0;
    const Advance &begin = advances.front(), &end = advances.back();
    const double growth = end.reach - begin.reach;
    if (growth < least_growth * crack.spacing) return 0;
    double t = 0, s = 0;
    for (const Advance& a : advances) {
        t += a.time / static_cast<double>(advances.size());
        s += a.reach / static_cast<double>(advances.size());
    }
    double ts = 0, tt = 0;
    for (const Advance& a : advances) {
        ts += (a.time - t) * (a.reach - s);
        tt += (a.time - t) * (a.time - t);
    }
    // Had the crack gone on faster than this since its last advance, the next one would have been seen.
    return std::min(ts / tt, (growth + crack.spacing) / (time - begin.time));
}

template <int Dim>
CrackReading Cracks<Dim>::read(double time) const {
    if (leading_ < 0) return {};
    const Crack& crack = cracks_[leading_];
    return {length_, to_3d<Dim>(crack.tip), speed(crack, time)};
}

template <int Dim>
Fragments find_fragments(const Model<Dim>& model, const State<Dim>& state) {
    const int n = model.particles.count();
    const std::vector<int> part = connected_parts(model.bonds, [&](int b) { return state.is_intact(b); });
    std::vector<double> mass(n, 0);
    std::vector<int> size(n, 0);
    for (int i = 0; i < n; ++i) {
        mass[part[i]] += model.particles.mass[i];
        ++size[part[i]];
    }
    Fragments fragments;
    for (int i = 0; i < n; ++i) {
        if (size[i] == 1) fragments.debris += mass[i];
        if (size[i] < 2) continue;
        ++fragments.count;
        fragments.largest = std::max(fragments.largest, mass[i]);
    }
    return fragments;
}

template class Cracks<2>;
template Fragments find_fragments<2>(const Model<2>&, const State<2>&);
template Fragments find_fragments<3>(const Model<3>&, const State<3>&);

}  // namespace hibi
