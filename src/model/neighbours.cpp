#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/parallel.hpp"
#include "model/model.hpp"

namespace hibi {

/// Points are sorted into square cells of size `radius`; each looks into the cells around its own. The cells
/// lie in one sorted list, so empty space costs nothing.
template <int Dim>
std::vector<std::pair<int, int>> neighbours(const std::vector<Vec<Dim>>& points, double radius) {
    static_assert(Dim == 2, "the loop over cells below is plane");
    const int n = static_cast<int>(points.size());
    if (n == 0) return {};
    Vec<Dim> low = points.front();
    for (const Vec<Dim>& p : points) low = low.cwiseMin(p);

    using Cell = std::pair<std::int64_t, std::int64_t>;  // row, column
    const auto cell_of = [&](const Vec<Dim>& p) {
        return Cell{static_cast<std::int64_t>((p.y() - low.y()) / radius),
                    static_cast<std::int64_t>((p.x() - low.x()) / radius)};
    };
    std::vector<std::pair<Cell, int>> sorted(n);
    for (int i = 0; i < n; ++i) sorted[i] = {cell_of(points[i]), i};
    std::sort(sorted.begin(), sorted.end());

    std::vector<std::vector<std::pair<int, int>>> found(block_count(n));
    parallel_for(n, [&](int begin, int end) {
        auto& mine = found[begin / parallel_block];
        for (int i = begin; i < end; ++i) {
            const auto [row, column] = cell_of(points[i]);
            for (std::int64_t r = row - 1; r <= row + 1; ++r) {
                auto at = std::lower_bound(sorted.begin(), sorted.end(), std::pair{Cell{r, column - 1}, -1});
                for (; at != sorted.end() && at->first <= Cell{r, column + 1}; ++at) {
                    const int j = at->second;
                    if (j > i && (points[j] - points[i]).squaredNorm() < radius * radius)
                        mine.push_back({i, j});
                }
            }
        }
    });
    std::vector<std::pair<int, int>> pairs;
    for (auto& part : found) {
        std::sort(part.begin(), part.end());
        pairs.insert(pairs.end(), part.begin(), part.end());
    }
    return pairs;
}

template std::vector<std::pair<int, int>> neighbours<2>(const std::vector<Vec<2>>&, double);

}  // namespace hibi
