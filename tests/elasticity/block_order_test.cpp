#include "elasticity/block_order.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "base/parallel.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

TEST(BlockOrder, DoesTheSecondToABlockOnceAndOnlyWhenTheFirstIsDoneToItsSurroundings) {
    const int threads_before = threads();
    for (const auto& [columns, rows] : {std::pair(20, 20), {60, 40}, {300, 300}, {20000, 4}, {3, 40000}}) {
        const Model<2> model = test::plate(columns, rows, 1);
        const Bonds& bonds = model.bonds;
        const int blocks = block_count(model.particles.count());
        std::vector<std::vector<int>> reached(blocks);
        for (int b = 0; b < bonds.count(); ++b) {
            const int i = bonds.first[b] / parallel_block, j = bonds.second[b] / parallel_block;
            if (reached[i].empty() || reached[i].back() != j) reached[i].push_back(j);
            if (reached[j].empty() || reached[j].back() != i) reached[j].push_back(i);
        }
        for (const int threads : {1, 2, 3}) {
            set_threads(threads);
            const BlockOrder order(bonds);
            std::vector<std::atomic<int>> first(blocks), second(blocks);
            std::atomic<int> too_early = 0, soon = 0, firsts = 0;
            order.walk(
                [&](int b) {
                    ++first[b];
                    ++firsts;
                },
                [&](int b) {
                    ++second[b];
                    if (first[b] != 1) ++too_early;
                    for (const int other : reached[b])
                        if (first[other] != 1) ++too_early;
                    if (firsts < blocks) ++soon;
                });
            EXPECT_EQ(too_early, 0) << columns;
            for (int b = 0; b < blocks; ++b)
                EXPECT_TRUE(first[b] == 1 && second[b] == 1) << columns << " " << b;
            // but where a block leads to more than a segment
            if (blocks > 64 && columns < 1000) {
                EXPECT_GT(soon, blocks / 2) << columns;
            }
        }
    }
    set_threads(threads_before);
}

}  // namespace
}  // namespace hibi
