#pragma once
#include <vector>

#include "model/model.hpp"

namespace hibi {

/// Bodies that are bonded to each other, and what lies between two of their points: matter, or empty space
/// that no bond may cross.
template <int Dim>
class Matter {
 public:
    /// `members` are indices of bodies.
    Matter(const Model<Dim>& model, const std::vector<int>& members);

    /// Is there matter all the way from particle i to particle j? The way may bend aside by a quarter of a
    /// spacing: chords over a curved side and bonds along a rough one are none that cross a gap. It may pass
    /// from one body to another where they are no further than half a spacing apart. Jitter does not count:
    /// the way goes from the centre of the one cell to that of the other.
    bool joins(int i, int j) const;

 private:
    const Model<Dim>& model_;
    std::vector<int> members_;
    std::vector<Box<Dim>> boxes_;    ///< bounding the bodies of the model
    std::vector<char> convex_;       ///< per body of the model
    std::vector<char> near_a_side_;  ///< per particle: a bond may reach across a side of its body

    bool along(const std::vector<Vec<Dim>>& way, int from, int to) const;
};

}  // namespace hibi
