#pragma once
#include <span>
#include <vector>

#include "model/intact_bonds.hpp"

namespace hibi {

/// Keeps one path of intact bonds from a held to a loaded particle; only when a bond of that path breaks is
/// another one looked for. Exact at every step, and nearly free.
template <int Dim>
class LoadPath {
 public:
    /// Without a path to begin with, an empty list say, there is nothing that could be lost.
    LoadPath(std::vector<int> from, const std::vector<int>& to, const Bonds& bonds, const State<Dim>& state)
        : bonds_(bonds), from_(std::move(from)), to_(bonds.start.size() - 1, 0) {
        for (const int i : to) to_[i] = 1;
        existed_ = search(state);
    }

    bool existed() const { return existed_; }
    /// Is there still a path? `just_broken` are the bonds broken since the last call.
    bool holds(const State<Dim>& state, std::span<const int> just_broken) {
        if (lost_) return false;
        for (const int b : just_broken) {
            if (!on_path_[b]) continue;
            lost_ = !search(state);
            break;
        }
        return !lost_;
    }
    /// As if it had been asked at every step up to this state.
    void restore(const State<Dim>& state) { lost_ = !search(state); }

 private:
    bool search(const State<Dim>& state) {
        int end = -1;
        const std::vector<int> came_by = walk_along_intact_bonds(bonds_, state, from_, [&](int i) {
            if (to_[i]) end = i;
            return end < 0;
        });
        on_path_.assign(bonds_.count(), 0);
        if (end < 0) return false;
        for (int i = end; came_by[i] >= 0; i = bonds_.other(came_by[i], i)) on_path_[came_by[i]] = 1;
        return true;
    }

    const Bonds& bonds_;
    std::vector<int> from_;
    std::vector<char> to_;
    bool existed_ = false, lost_ = false;
    std::vector<char> on_path_;  ///< per bond
};

}  // namespace hibi
