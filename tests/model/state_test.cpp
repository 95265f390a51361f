#include "model/state.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "base/fields.hpp"
#include "support/member_count.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

/// Every field holds something that a careless copy would lose: signed zeros, numbers too small to be normal,
/// infinities, thirds.
State<2> filled() {
    constexpr double tiny = std::numeric_limits<double>::denorm_min();
    State<2> state;
    state.time = 1.0 / 3;
    state.step = 1ll << 40;
    state.displacement = {{-0.0, tiny}, {1e-300, 1.0 / 7}, {std::nextafter(1.0, 2), -1e300}};
    state.velocity = {{1, 2}, {3, 4}, {-0.0, 6}};
    state.force = {{-1, 0.1}, {0.2, 0.3}, {tiny, -tiny}};
    state.angle = {0.1, -0.0, 3};
    state.angular_velocity = {0.5, 1.0 / 9, 2};
    state.torque = {7, -8, 1.0 / 11};
    state.broken_at = {Bonds::intact, 0, 0.25};
    state.broken = 2;
    state.released = {0, 1};
    state.damping_rate = 0.3;
    state.energies = {1, 2, 3, 4, -0.0, 1.0 / 13};
    state.memories = {{"first", {1, -0.0}}, {"none", {}}};
    state.failure = "failed";
    state.collapse = "collapsed";
    state.instability = "unstable at t = 1 s";
    return state;
}

using Change = std::function<void(State<2>&)>;
/// One change of each field, the smallest there is where it is a number.
const std::vector<std::pair<std::string, Change>> changes = {
    {"time", [](State<2>& s) { s.time = std::nextafter(s.time, 1); }},
    {"step", [](State<2>& s) { ++s.step; }},
    {"displacement", [](State<2>& s) { s.displacement[0].x() = 0.0; }},
    {"velocity", [](State<2>& s) { s.velocity[2].x() = 0.0; }},
    {"force", [](State<2>& s) { s.force[2].x() = 0; }},
    {"angle", [](State<2>& s) { s.angle[1] = 0.0; }},
    {"angular_velocity", [](State<2>& s) { s.angular_velocity.pop_back(); }},
    {"torque", [](State<2>& s) { std::swap(s.torque[0], s.torque[1]); }},
    {"broken_at", [](State<2>& s) { s.broken_at[0] = 0.5; }},
    {"broken", [](State<2>& s) { ++s.broken; }},
    {"released", [](State<2>& s) { s.released[0] = 1; }},
    {"damping_rate", [](State<2>& s) { s.damping_rate = 0; }},
    {"energies", [](State<2>& s) { s.energies.released = 0.0; }},
    {"memories", [](State<2>& s) { s.memories[0].values[1] = 0.0; }},
    {"failure", [](State<2>& s) { s.failure.clear(); }},
    {"collapse", [](State<2>& s) { s.collapse += "."; }},
    {"instability", [](State<2>& s) { s.instability.pop_back(); }},
};

TEST(State, ItsListNamesEveryMember) {
    // A member that is added and not listed would be lost on the way from one simulation to another.
    EXPECT_EQ(test::listed_fields(State<2>{}), test::member_count<State<2>>());
    EXPECT_EQ(test::listed_fields(State<3>{}), test::member_count<State<3>>());
    EXPECT_EQ(test::listed_fields(Energies{}), test::member_count<Energies>());
    EXPECT_EQ(test::listed_fields(Memory{}), test::member_count<Memory>());
    EXPECT_EQ(test::listed_fields(Particles<2>{}), test::member_count<Particles<2>>());
}

TEST(State, DifferingFieldsNamesTheOneThatChangedByABit) {
    std::set<std::string> listed, tried;
    const State<2> all = filled();
    State<2>::each_field(all, [&](const char* name, const auto&) { listed.insert(name); });
    for (const auto& [name, change] : changes) {
        State<2> other = filled();
        EXPECT_TRUE(differing_fields(filled(), other).empty());
        change(other);
        EXPECT_EQ(differing_fields(filled(), other), std::vector<std::string>{name});
        EXPECT_NE(hash_of(filled()), hash_of(other)) << name;
        tried.insert(name);
    }
    EXPECT_EQ(tried, listed);
}

TEST(State, BytesBringBackEveryFieldBitForBit) {
    const State<2> before = filled();
    State<2> after;
    after.memories = {{"to be overwritten", {1, 2, 3}}};
    from_bytes(to_bytes(before), after);
    EXPECT_TRUE(differing_fields(before, after).empty());
    EXPECT_EQ(to_bytes(before), to_bytes(after));
    // Apart from the bytes that are to be judged.
    EXPECT_EQ(after.time, before.time);
    EXPECT_EQ(after.step, before.step);
    EXPECT_EQ(after.displacement, before.displacement);
    EXPECT_TRUE(std::signbit(after.displacement[0].x()));
    EXPECT_EQ(after.velocity, before.velocity);
    EXPECT_EQ(after.force, before.force);
    EXPECT_EQ(after.angle, before.angle);
    EXPECT_EQ(after.angular_velocity, before.angular_velocity);
    EXPECT_EQ(after.torque, before.torque);
    EXPECT_EQ(after.broken_at, before.broken_at);
    EXPECT_EQ(after.broken, before.broken);
    EXPECT_EQ(after.released, before.released);
    EXPECT_EQ(after.damping_rate, before.damping_rate);
    EXPECT_EQ(after.energies.sum(), before.energies.sum());
    EXPECT_EQ(after.energies.work, before.energies.work);
    ASSERT_EQ(after.memories.size(), 2u);
    EXPECT_EQ(after.memories[0].name, "first");
    EXPECT_EQ(after.memories[0].values, before.memories[0].values);
    EXPECT_EQ(after.memories[1].name, "none");
    EXPECT_TRUE(after.memories[1].values.empty());
    EXPECT_EQ(after.failure, before.failure);
    EXPECT_EQ(after.collapse, before.collapse);
    EXPECT_EQ(after.instability, before.instability);
}

TEST(State, OfTheStartHasTheInitialVelocityAndNothingElse) {
    Model<2> model = test::plate(4, 3, 1);
    for (int i = 0; i < model.particles.count(); ++i) model.particles.initial_velocity[i] = {i, -1};
    const State<2> state = initial_state(model);
    EXPECT_EQ(state.velocity, model.particles.initial_velocity);
    EXPECT_EQ(state.displacement, std::vector<Vec<2>>(12, Vec<2>::Zero()));
    EXPECT_EQ(state.force, std::vector<Vec<2>>(12, Vec<2>::Zero()));
    EXPECT_EQ(state.broken_at, std::vector<double>(model.bonds.count(), Bonds::intact));
    State<2> rest = state;
    for (auto* vectors : {&rest.displacement, &rest.velocity, &rest.force}) vectors->clear();
    rest.broken_at.clear();
    EXPECT_TRUE(differing_fields(rest, State<2>{}).empty());
}

TEST(State, HandlesOfMemoriesAreTheirPlaces) {
    State<2> state;
    const int first = state.remember("first", 2), second = state.remember("second", 1, 5);
    state.memory(first)[1] = 7;
    EXPECT_EQ(state.memories[0].values, (std::vector<double>{0, 7}));
    EXPECT_EQ(std::as_const(state).memory(second), std::vector<double>{5});
    EXPECT_EQ(state.memories[1].name, "second");
}

}  // namespace
}  // namespace hibi
