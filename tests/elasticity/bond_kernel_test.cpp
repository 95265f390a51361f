#include "elasticity/bond_kernel.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>

#include "base/parallel.hpp"
#include "elasticity/elastic_law.hpp"
#include "support/plain_bonds.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

/// Bodies that bring every kind of chunk: rows alike, surfaces, ragged rows, no lattice at all, two
/// materials.
struct Case {
    const char* name;
    double influence;
    Shape<2> shape;
    Lattice lattice{};
    bool second_body = false;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

Model<2> build(const Case& c) {
    Model<2> model;
    Material soft = test::concrete();
    soft.name = "soft";
    soft.youngs_modulus /= 3;
    model.materials = {test::concrete(), soft};
    model.influence = c.influence;
    add_body<2>(model, {.name = "body", .shape = c.shape, .spacing = 0.5, .lattice = c.lattice});
    if (c.second_body)
        add_body<2>(model, {.name = "second",
                            .shape = {Box<2>{{10, 0}, {13.5, 9}}},
                            .spacing = 0.5,
                            .material = 1,
                            .bonded_to = {0}});
    connect<2>(model, {{.name = "notch", .points = {{0, 4.1}, {3, 4.1}}}});
    return model;
}

/// Which loops() are taken, while it lives.
class Level {
 public:
    explicit Level(const char* level) { setenv("HIBI_CPU_LEVEL", level, 1); }
    ~Level() { unsetenv("HIBI_CPU_LEVEL"); }
};

double largest(const std::vector<Vec<2>>& vectors) {
    double most = 0;
    for (const Vec<2>& v : vectors) most = std::max(most, v.norm());
    return most;
}

class Loops : public testing::TestWithParam<Case> {
 protected:
    const Model<2> model_ = build(GetParam());
    State<2> state_ = initial_state(model_);
    ElasticCoefficients coefficients_ = elastic_coefficients(model_);

    /// Forces of the loops and of the plain loop on the disturbed body, before and after breaks.
    template <class Compare>
    void judge(Compare&& compare) {
        const auto law = make_elastic_law<2>(model_, Elasticity::moment_matched);
        test::turn_and_shake(model_, state_, 0.7, 0.05);
        law->forces(state_);
        ASSERT_GT(largest(state_.force), 0);
        compare(state_.force, test::plain_forces(model_, state_, coefficients_));
        for (int b = 0; b < model_.bonds.count(); b += 41) {
            state_.broken_at[b] = 1;
            law->remove(b);
        }
        law->forces(state_);
        compare(state_.force, test::plain_forces(model_, state_, coefficients_));
    }
};

TEST_P(Loops, GiveTheBitsOfThePlainLoopOnEveryLevel) {
    for (const char* name : {"v2", "v3", "v4"}) {
        const Level level(name);
        judge([&](const std::vector<Vec<2>>& fast, const std::vector<Vec<2>>& plain) {
            EXPECT_TRUE(fast == plain) << kernel::loops().level;
        });
        state_ = initial_state(model_);
    }
}

TEST_P(Loops, EnergyIsTheSumOfTheParticles) {
    const auto law = make_elastic_law<2>(model_, Elasticity::moment_matched);
    test::turn_and_shake(model_, state_, 0.7, 0.05);
    double sum = 0;
    for (int i = 0; i < model_.particles.count(); ++i) sum += law->local(state_, i).energy;
    EXPECT_NEAR(law->energy(state_), sum, 1e-13 * sum);
}

TEST_P(Loops, StatesAreThoseOfEachParticle) {
    const auto law = make_elastic_law<2>(model_, Elasticity::moment_matched);
    test::turn_and_shake(model_, state_, 0.7, 0.05);
    const int n = model_.particles.count();
    law->update_displacements(state_, 0, n);
    const double scale = 0.05 * 2.1e8;
    for (int begin = 0; begin < n; begin += parallel_block) {
        const int end = std::min(n, begin + parallel_block);
        const std::vector<LocalState<2>> states = law->local(state_, begin, end);
        ASSERT_EQ(states.size(), static_cast<std::size_t>(end - begin));
        for (int i = begin; i < end; ++i) {
            const LocalState<2> one = law->local(state_, i);
            EXPECT_NEAR(states[i - begin].energy, one.energy, 1e-13 * scale);
            EXPECT_NEAR(states[i - begin].dilatation, one.dilatation, 1e-14);
            EXPECT_EQ(states[i - begin].bond_strain, one.bond_strain);
            EXPECT_LT((states[i - begin].stress - one.stress).norm(), 1e-13 * scale) << i;
        }
    }
}

TEST_P(Loops, NameTheBlockOfABondBeyondItsLimitAndNoOther) {
    // Strains of 10 % either way, as (L^2 - L0^2) / L0^2.
    BreakLimits limits{std::vector<double>(model_.bonds.count(), 0.21),
                       std::vector<double>(model_.bonds.count(), -0.19)};
    const int weak = 2 * model_.bonds.count() / 3;
    limits.upper[weak] = 0.001;
    const auto law = make_elastic_law<2>(model_, Elasticity::moment_matched, limits);
    std::vector<Vec<2>>& u = state_.displacement;
    const auto stretched = [&](double strain) {
        for (std::size_t i = 0; i < u.size(); ++i) u[i] = strain * model_.particles.reference_position[i];
        law->update_displacements(state_, 0, model_.particles.count());
        return law->sum_forces(state_);
    };
    EXPECT_EQ(stretched(0.0004), std::vector<int>{});
    EXPECT_EQ(stretched(0.0006), std::vector<int>{model_.bonds.first[weak] / parallel_block});
    EXPECT_NE(stretched(0.2), std::vector<int>{});
    law->remove(weak);
    EXPECT_EQ(stretched(0.0006), std::vector<int>{});
    for (std::size_t i = 0; i < u.size(); ++i)
        u[i] = -2 * model_.particles.reference_position[i];  // half a turn
    law->update_displacements(state_, 0, model_.particles.count());
    EXPECT_EQ(law->sum_forces(state_), std::vector<int>{});
}

INSTANTIATE_TEST_SUITE_P(
    Bodies, Loops,
    testing::Values(Case{"Plate", 2.1, {Box<2>{{0, 0}, {21.5, 20}}}},
                    Case{"PlateOfWideInfluence", 3.1, {Box<2>{{0, 0}, {21.5, 20}}}},
                    Case{"Disc", 2.1, {Disc<2>{{8, 8}, 8}}},
                    Case{"Turned", 2.1, {Box<2>{{0, 0}, {20, 20}}}, {.angle = 0.3}},
                    Case{"Jittered", 2.1, {Box<2>{{0, 0}, {20, 20}}}, {.jitter = 0.1, .seed = 3}},
                    Case{"TwoMaterials", 2.1, {Box<2>{{0, 0}, {10, 9}}}, {}, true},
                    Case{"ThreeColumns", 2.1, {Box<2>{{0, 0}, {1.5, 20}}}},
                    Case{"OneRow", 2.1, {Box<2>{{0, 0}, {6, 0.5}}}}),
    [](const auto& param) { return std::string(param.param.name); });

}  // namespace
}  // namespace hibi
