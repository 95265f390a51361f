#include "measure/load_path.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "support/plates.hpp"

namespace hibi {
namespace {

using test::plate;
using test::where;

TEST(LoadPath, AgreesWithUnionFindAfterEveryBreak) {
    std::mt19937 random(11);
    for (int trial = 0; trial < 20; ++trial) {
        const Model<2> model = plate(12, 6, 1);
        const auto from = where(model, [](const Vec<2>& X) { return X.x() < 1; });
        const auto to = where(model, [](const Vec<2>& X) { return X.x() > 11; });
        State<2> state = initial_state(model);
        LoadPath<2> path(from, to, model.bonds, state);
        ASSERT_TRUE(path.existed());
        std::vector<int> order(model.bonds.count());
        std::iota(order.begin(), order.end(), 0);
        std::shuffle(order.begin(), order.end(), random);
        bool ever_apart = false;
        for (const int b : order) {
            state.broken_at[b] = 1;
            std::vector<int> root(model.particles.count());
            std::iota(root.begin(), root.end(), 0);
            const auto find = [&](int i) {
                while (root[i] != i) i = root[i] = root[root[i]];
                return i;
            };
            for (int k = 0; k < model.bonds.count(); ++k)
                if (state.is_intact(k)) root[find(model.bonds.first[k])] = find(model.bonds.second[k]);
            bool together = false;
            for (const int i : from)
                for (const int j : to) together |= find(i) == find(j);
            ASSERT_EQ(path.holds(state, std::vector<int>{b}), together);
            ever_apart |= !together;
            if (ever_apart) break;
        }
        EXPECT_TRUE(ever_apart);
    }
}

}  // namespace
}  // namespace hibi
