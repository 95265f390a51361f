#include "breaking/breaking.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace hibi {

template <int Dim>
void Breaking<Dim>::begin_step(State<Dim>&) {
    just_broken_.clear();
    breaking_strains_.clear();
}

template <int Dim>
void Breaking<Dim>::end_step(State<Dim>& state) {
    const std::vector<int>& suspects = interactions_.elastic().suspects;
    if (suspects.empty()) return;
    const Bonds& bonds = model_.bonds;
    const BreakLimits& limits = interactions_.elastic().limits();
    std::vector<int> beyond;
    for (const int block : suspects) {
        const int begin = block * parallel_block,
                  end = std::min(model_.particles.count(), begin + parallel_block);
        // The bonds whose first particle lies in the block follow one another.
        const auto first = std::lower_bound(bonds.first.begin(), bonds.first.end(), begin);
        for (auto b = static_cast<int>(first - bonds.first.begin());
             b < bonds.count() && bonds.first[b] < end; ++b) {
            if (!state.is_intact(b)) continue;
            const Vec<Dim>& r0 = model_.bond_vectors[b];
            const Vec<Dim> du = stretch(state, b);
            const double growth = 2 * r0.dot(du) + du.squaredNorm(), square = r0.squaredNorm();
            if (growth > limits.upper[b] * square || growth < limits.lower[b] * square) beyond.push_back(b);
        }
    }
    if (beyond.empty()) return;
    break_bonds(state, std::move(beyond));
    std::vector<int> blocks;
    for (const int b : just_broken_) {
        for (const int i : {bonds.first[b], bonds.second[b]}) {
            blocks.push_back(i / parallel_block);
            for (int k = bonds.start[i]; k < bonds.start[i + 1]; ++k)
                blocks.push_back(bonds.other(bonds.bonds_of[k], i) / parallel_block);
        }
    }
    std::ranges::sort(blocks);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
    interactions_.recompute_forces(state, blocks);
}

template <int Dim>
void Breaking<Dim>::break_bonds(State<Dim>& state, std::vector<int> broken) {
    const Bonds& bonds = model_.bonds;
    ElasticLaw<Dim>& law = interactions_.elastic().law();
    just_broken_ = std::move(broken);
    for (const int b : just_broken_)
        breaking_strains_.push_back(bond_strain<Dim>(model_.bond_vectors[b], stretch(state, b)));
    // Only the ends of broken bonds change their energy.
    std::vector<int> ends;
    for (const int b : just_broken_) ends.insert(ends.end(), {bonds.first[b], bonds.second[b]});
    std::sort(ends.begin(), ends.end());
    ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
    const auto energy = [&] {
        double sum = 0;
        for (const int i : ends) sum += law.local(state, i).energy;
        return sum;
    };
    const double before = energy();
    for (const int b : just_broken_) {
        state.broken_at[b] = state.time;
        law.remove(b);
    }
    state.broken += static_cast<int>(just_broken_.size());
    state.energies.released += before - energy();
}

template <int Dim>
double Breaking<Dim>::utilisation(const State<Dim>& state, int bond) const {
    const BreakLimits& limits = interactions_.elastic().limits();
    const std::vector<Vec<Dim>>& X = model_.particles.reference_position;
    const Vec<Dim> r0 = X[model_.bonds.second[bond]] - X[model_.bonds.first[bond]];
    const Vec<Dim> du = stretch(state, bond);
    const double growth = (2 * r0.dot(du) + du.squaredNorm()) / r0.squaredNorm();
    return growth / (growth > 0 ? limits.upper[bond] : limits.lower[bond]);
}

template <int Dim>
double Breaking<Dim>::closest_to_breaking(const State<Dim>& state) const {
    const BreakLimits& limits = interactions_.elastic().limits();
    double closest = 0;
    for (int b = 0; b < model_.bonds.count(); ++b) {
        if (!state.is_intact(b)) continue;
        const double strain = bond_strain<Dim>(model_.bond_vectors[b], stretch(state, b));
        const double bound = strain > 0 ? limits.upper[b] : limits.lower[b];
        if (std::isfinite(bound)) closest = std::max(closest, strain / (std::sqrt(1 + bound) - 1));
    }
    return closest;
}

template class Breaking<2>;

}  // namespace hibi
