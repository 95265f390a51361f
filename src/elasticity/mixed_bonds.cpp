#include "elasticity/mixed_bonds.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/parallel.hpp"

namespace hibi {

namespace {

/// Places along a bond are rounded to this part of its length, so that bonds alike have the same bits.
constexpr double grain = 0x1p-20;

/// Calls visit(particle, length) for each piece of a bond, from its first end to its second; the lengths are
/// parts of the bond's and sum to 1.
template <int Dim, class Visit>
void each_piece(const Model<Dim>& model, int b, Visit&& visit) {
    const Bonds& bonds = model.bonds;
    const std::vector<Vec<Dim>>& X = model.particles.reference_position;
    const Vec<Dim>& r0 = model.bond_vectors[b];
    const int first = bonds.first[b];
    // |X_first + t r0 - X_p|^2 less what all p have in common is a straight line over t; the piece of p is
    // where its line is the lowest.
    struct Line {
        int particle;
        double at_start, slope;
    };
    std::vector<Line> lines;
    const auto add = [&](int p) {
        const Vec<Dim> away = X[first] - X[p];
        lines.push_back({p, away.squaredNorm(), 2 * r0.dot(away)});
    };
    for (const int end : {first, bonds.second[b]}) {
        add(end);
        for (int k = bonds.start[end]; k < bonds.start[end + 1]; ++k)
            add(bonds.other(bonds.bonds_of[k], end));
    }
    Line now = lines.front();
    for (double t = 0; t < 1;) {
        double until = 1;
        const Line* next = nullptr;
        for (const Line& line : lines) {
            if (line.slope >= now.slope) continue;
            const double crossing = (line.at_start - now.at_start) / (now.slope - line.slope);
            if (crossing < until) until = crossing, next = &line;
        }
        until = std::max(t, std::round(until / grain) * grain);
        if (until > t) visit(now.particle, until - t);
        t = until;
        if (!next) break;
        now = *next;
    }
}

}  // namespace

template <int Dim>
std::vector<MixedBond> mixed_bonds(const Model<Dim>& model) {
    const Bonds& bonds = model.bonds;
    std::vector<double> moduli;
    for (const Material& material : model.materials) moduli.push_back(shear_modulus(material));
    if (std::adjacent_find(moduli.begin(), moduli.end(), std::not_equal_to<>()) == moduli.end()) return {};
    const auto mu = [&](int i) { return moduli[model.particles.material[i]]; };
    std::vector<char> beside_another(model.particles.count(), 0);
    bool any = false;
    for (int b = 0; b < bonds.count(); ++b) {
        if (mu(bonds.first[b]) == mu(bonds.second[b])) continue;
        beside_another[bonds.first[b]] = beside_another[bonds.second[b]] = any = true;
    }
    std::vector<MixedBond> mixed;
    if (!any) return mixed;
    std::vector<std::vector<MixedBond>> of_block(block_count(bonds.count()));
    parallel_for(bonds.count(), [&](int begin, int end) {
        for (int b = begin; b < end; ++b) {
            const int i = bonds.first[b], j = bonds.second[b];
            if (!beside_another[i] && !beside_another[j]) continue;
            MixedBond bond{.bond = b};
            double compliance = 0, as_first = 0, as_second = 0;
            bool changes = false;
            each_piece(model, b, [&](int p, double length) {
                compliance += length / mu(p);
                as_first += mu(p) == mu(i) ? length : 0;
                as_second += mu(p) == mu(j) ? length : 0;
                changes = changes || mu(p) != mu(i);
                bond.materials.push_back(model.particles.material[p]);
            });
            if (!changes) continue;
            bond.modulus = 1 / compliance;
            bond.first_length = as_first / (as_first + as_second);
            std::sort(bond.materials.begin(), bond.materials.end());
            bond.materials.erase(std::unique(bond.materials.begin(), bond.materials.end()),
                                 bond.materials.end());
            of_block[begin / parallel_block].push_back(std::move(bond));
        }
    });
    for (std::vector<MixedBond>& part : of_block)
        mixed.insert(mixed.end(), std::make_move_iterator(part.begin()), std::make_move_iterator(part.end()));
    return mixed;
}

template std::vector<MixedBond> mixed_bonds<2>(const Model<2>&);

}  // namespace hibi
