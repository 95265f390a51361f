#include "model/intact_bonds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "support/plates.hpp"

namespace hibi {
namespace {

/// The slow, obvious counterparts of the walks: over all bonds, until nothing changes any more.
struct Slow {
    const Bonds& bonds;
    const State<2>& state;

    std::vector<std::pair<int, int>> bonds_of(int i) const {
        std::vector<std::pair<int, int>> found;  // other end, bond
        for (int b = 0; b < bonds.count(); ++b) {
            if (!(state.broken_at[b] > 1e300)) continue;
            if (bonds.first[b] == i) found.push_back({bonds.second[b], b});
            if (bonds.second[b] == i) found.push_back({bonds.first[b], b});
        }
        return found;
    }
    /// Fewest intact bonds to any of `from`; -1: there is no way.
    std::vector<int> distances(const std::vector<int>& from) const {
        std::vector<int> distance(bonds.start.size() - 1, -1);
        for (const int i : from) distance[i] = 0;
        for (int round = 0; std::cmp_less(round, distance.size()); ++round)
            for (int b = 0; b < bonds.count(); ++b) {
                if (!(state.broken_at[b] > 1e300)) continue;
                for (const auto& [i, j] :
                     {std::pair(bonds.first[b], bonds.second[b]), std::pair(bonds.second[b], bonds.first[b])})
                    if (distance[i] == round && distance[j] < 0) distance[j] = round + 1;
            }
        return distance;
    }
    std::vector<int> parts() const {
        std::vector<int> part(bonds.start.size() - 1);
        for (std::size_t i = 0; i < part.size(); ++i) part[i] = static_cast<int>(i);
        for (bool changed = true; std::exchange(changed, false);)
            for (int b = 0; b < bonds.count(); ++b) {
                if (!(state.broken_at[b] > 1e300)) continue;
                int &one = part[bonds.first[b]], &other = part[bonds.second[b]];
                changed = changed || one != other;
                one = other = std::min(one, other);
            }
        return part;
    }
};

class RandomlyBroken : public testing::TestWithParam<int> {  // per cent of the bonds
 protected:
    Model<2> model_ = test::plate(13, 9, 1);
    State<2> state_ = initial_state(model_);
    std::mt19937 random_{static_cast<unsigned>(GetParam())};
    const Slow slow_{model_.bonds, state_};

    RandomlyBroken() {
        for (double& at : state_.broken_at)
            if (std::cmp_less(random_() % 100, GetParam())) at = 0.5;
    }
    int random_particle() { return static_cast<int>(random_() % model_.particles.count()); }
};

TEST_P(RandomlyBroken, EachIntactBondIsVisitedOnceInRisingOrder) {
    for (int i = 0; i < model_.particles.count(); ++i) {
        std::vector<std::pair<int, int>> visited;
        each_intact_bond(model_.bonds, state_, i, [&](int j, int b) { visited.push_back({j, b}); });
        EXPECT_EQ(visited, slow_.bonds_of(i)) << i;
    }
}

TEST_P(RandomlyBroken, WalkReachesWhatASlowSearchReachesByAsFewBonds) {
    for (int trial = 0; trial < 20; ++trial) {
        std::vector<int> from{random_particle(), random_particle()};
        from.push_back(from.front());  // named twice, it is still one
        const std::vector<int> distance = slow_.distances(from);
        std::vector<int> visited;
        const std::vector<int> came_by = walk_along_intact_bonds(model_.bonds, state_, from, [&](int i) {
            visited.push_back(i);
            return true;
        });
        EXPECT_TRUE(std::ranges::is_sorted(visited, {}, [&](int i) { return distance[i]; }));
        std::ranges::sort(visited);
        EXPECT_EQ(std::ranges::adjacent_find(visited), visited.end());
        for (int i = 0; i < model_.particles.count(); ++i) {
            EXPECT_EQ(std::ranges::binary_search(visited, i), distance[i] >= 0) << i;
            EXPECT_EQ(came_by[i] == not_reached, distance[i] < 0) << i;
            EXPECT_EQ(came_by[i] == walk_begins, distance[i] == 0) << i;
            if (came_by[i] < 0) continue;
            EXPECT_TRUE(state_.is_intact(came_by[i]));
            EXPECT_EQ(distance[model_.bonds.other(came_by[i], i)], distance[i] - 1) << i;
        }
    }
}

TEST_P(RandomlyBroken, WalkStopsWhereItIsTold) {
    const std::vector<int> from{random_particle()};
    const std::vector<int> distance = slow_.distances(from);
    const int reach = *std::ranges::max_element(distance);
    int visits = 0;
    const std::vector<int> came_by = walk_along_intact_bonds(model_.bonds, state_, from, [&](int i) {
        ++visits;
        return distance[i] < reach;
    });
    EXPECT_EQ(visits, 1 + std::ranges::count_if(distance, [&](int d) { return d >= 0 && d < reach; }));
    for (int i = 0; i < model_.particles.count(); ++i)
        if (came_by[i] >= 0) {
            EXPECT_LE(distance[i], reach);
        }
}

TEST_P(RandomlyBroken, PartsAreThoseOfASlowSearchEachNamedByItsLowestParticle) {
    EXPECT_EQ(connected_parts(model_.bonds, [&](int b) { return state_.is_intact(b); }), slow_.parts());
}

INSTANTIATE_TEST_SUITE_P(PerCent, RandomlyBroken, testing::Values(0, 20, 50, 70, 85, 95, 100));

}  // namespace
}  // namespace hibi
