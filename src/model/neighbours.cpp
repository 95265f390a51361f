#include <algorithm>

#include "base/parallel.hpp"
#include "model/cell_grid.hpp"
#include "model/model.hpp"

namespace hibi {

template <int Dim>
std::vector<std::pair<int, int>> neighbours(const std::vector<Vec<Dim>>& points, double radius) {
    CellGrid<Dim> grid;
    grid.build(points, radius);
    std::vector<std::vector<std::pair<int, int>>> found(block_count(grid.count()));
    parallel_for(grid.count(), [&](int begin, int end) {
        auto& mine = found[begin / parallel_block];
        for (int i = begin; i < end; ++i)
            grid.each_near(i, radius, [&](int j) {
                if (j > i) mine.push_back({i, j});
            });
        std::sort(mine.begin(), mine.end());
    });
    std::vector<std::pair<int, int>> pairs;
    for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    return pairs;
}

template std::vector<std::pair<int, int>> neighbours<2>(const std::vector<Vec<2>>&, double);
template std::vector<std::pair<int, int>> neighbours<3>(const std::vector<Vec<3>>&, double);

}  // namespace hibi
