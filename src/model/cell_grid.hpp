#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/vec.hpp"

namespace hibi {

/// Points sorted into cubic cells, so that those near a place are found without looking at all of them. The
/// cells lie in one sorted list: empty space costs nothing. Whoever visits sees the points in an order that
/// depends on their positions and numbers alone, so it is the same on any number of threads.
template <int Dim>
class CellGrid {
 public:
    /// `cell`: side of the cells (m); the largest radius that will be asked for is a good choice. The points
    /// are copied.
    void build(std::vector<Vec<Dim>> points, double cell) {
        points_ = std::move(points);
        cell_ = cell;
        if (points_.empty()) return sorted_.clear();
        low_ = points_.front();
        for (const Vec<Dim>& p : points_) low_ = low_.cwiseMin(p);
        sorted_.resize(points_.size());
        for (std::size_t i = 0; i < points_.size(); ++i)
            sorted_[i] = {cell_of(points_[i]), static_cast<int>(i)};
        std::sort(sorted_.begin(), sorted_.end());
    }

    int count() const { return static_cast<int>(points_.size()); }
    const std::vector<Vec<Dim>>& points() const { return points_; }

    /// Calls visit(j) for every point nearer to the place than `radius` (m).
    template <class Visit>
    void each_near(const Vec<Dim>& place, double radius, Visit&& visit) const {
        const auto reach = static_cast<std::int64_t>(std::ceil(radius / cell_));
        const Cell centre = cell_of(place);
        // All cells of a row along x lie side by side in the list.
        Cell row = centre;
        const auto walk_row = [&] {
            Cell first = row, last = row;
            first[Dim - 1] = centre[Dim - 1] - reach;
            last[Dim - 1] = centre[Dim - 1] + reach;
            auto at = std::lower_bound(sorted_.begin(), sorted_.end(), std::pair{first, -1});
            for (; at != sorted_.end() && at->first <= last; ++at)
                if ((points_[at->second] - place).squaredNorm() < radius * radius) visit(at->second);
        };
        const auto walk = [&](auto& self, int axis) -> void {
            if (axis == Dim - 1) return walk_row();
            for (row[axis] = centre[axis] - reach; row[axis] <= centre[axis] + reach; ++row[axis])
                self(self, axis + 1);
        };
        walk(walk, 0);
    }
    /// The same about point i, itself left out.
    template <class Visit>
    void each_near(int i, double radius, Visit&& visit) const {
        each_near(points_[i], radius, [&](int j) {
            if (j != i) visit(j);
        });
    }

 private:
    using Cell = std::array<std::int64_t, Dim>;  ///< along ..., y, x: rows along x stay together

    Cell cell_of(const Vec<Dim>& p) const {
        Cell cell;
        for (int a = 0; a < Dim; ++a)
            cell[Dim - 1 - a] = static_cast<std::int64_t>(std::floor((p[a] - low_[a]) / cell_));
        return cell;
    }

    std::vector<Vec<Dim>> points_;
    std::vector<std::pair<Cell, int>> sorted_;
    Vec<Dim> low_ = Vec<Dim>::Zero();
    double cell_ = 1;
};

}  // namespace hibi
