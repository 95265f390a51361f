#include "record/states.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "record/example.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

using example::message_of;

/// A folder that holds the topology of the example.
class States : public ::testing::Test {
 protected:
    States() { write_topology(folder_.path(), topology_); }

    std::filesystem::path written(const Snapshot& snapshot) const {
        write_state(folder_.path(), topology_, snapshot);
        return state_file(folder_.path(), snapshot.step);
    }

    TemporaryFolder folder_;
    Topology topology_ = example::topology();
};

TEST_F(States, TopologyComesBackBitForBit) {
    const Topology t = read_topology(folder_.path());
    EXPECT_EQ(t.dimension, topology_.dimension);
    EXPECT_EQ(t.thickness, topology_.thickness);
    EXPECT_EQ(t.reference_position, topology_.reference_position);
    EXPECT_EQ(t.spacing, topology_.spacing);
    EXPECT_EQ(t.body, topology_.body);
    EXPECT_EQ(t.body_names, topology_.body_names);
    EXPECT_EQ(t.first, topology_.first);
    EXPECT_EQ(t.second, topology_.second);
    EXPECT_EQ(t.rest_length, topology_.rest_length);
    EXPECT_EQ(t.notches, topology_.notches);
    ASSERT_EQ(t.supports.size(), 2u);
    EXPECT_EQ(t.supports[0].name, "clamp");
    EXPECT_EQ(t.supports[0].particles, topology_.supports[0].particles);
    EXPECT_EQ(t.supports[0].axes, topology_.supports[0].axes);
    EXPECT_EQ(t.supports[1].name, "");
    ASSERT_EQ(t.loads.size(), 1u);
    EXPECT_EQ(t.loads[0].name, "tip, right");
    EXPECT_EQ(t.loads[0].kind, "force");
    EXPECT_EQ(t.loads[0].particles, topology_.loads[0].particles);
    EXPECT_EQ(t.loads[0].direction, topology_.loads[0].direction);
    EXPECT_TRUE(t.loads[0].primary);
}

TEST_F(States, StateComesBackBitForBit) {
    Snapshot expected = example::snapshot(20);
    expected.angle = {0.1, -0.2, 1.0 / 3};
    const Snapshot s = read_state(written(expected), topology_);
    EXPECT_EQ(s.time, expected.time);
    EXPECT_EQ(s.step, expected.step);
    EXPECT_EQ(s.displacement, expected.displacement);
    EXPECT_EQ(s.velocity, expected.velocity);
    EXPECT_TRUE(std::signbit(s.velocity[2].y()));  // -0.0 stays what it was
    EXPECT_EQ(s.angle, expected.angle);
    EXPECT_EQ(s.broken, expected.broken);
    EXPECT_EQ(s.broken_at, expected.broken_at);
    EXPECT_EQ(s.bond_strain, expected.bond_strain);
    EXPECT_EQ(s.damage, expected.damage);
    EXPECT_EQ(s.energy, expected.energy);
    EXPECT_EQ(s.stress, expected.stress);
}

TEST_F(States, OnlyTheArraysNamedAreRead) {
    Snapshot expected = example::snapshot(20);
    expected.angle = {0.1, -0.2, 1.0 / 3};
    const Snapshot s = read_state(written(expected), topology_, {"displacement", "stress"});
    EXPECT_EQ(s.displacement, expected.displacement);
    EXPECT_EQ(s.stress, expected.stress);
    EXPECT_EQ(s.time, expected.time);
    EXPECT_EQ(s.broken, expected.broken);
    EXPECT_TRUE(s.velocity.empty() && s.angle.empty() && s.bond_strain.empty() && s.damage.empty() &&
                s.energy.empty());
}

TEST_F(States, WithoutAnglesNoneComeBack) {
    EXPECT_TRUE(read_state(written(example::snapshot(0)), topology_).angle.empty());
}

/// So many particles that every array has several chunks, the last one partly filled.
Snapshot large_snapshot() {
    constexpr int count = 100'000;
    Snapshot s;
    s.bond_strain.assign(count, 1);
    s.damage = s.energy = s.bond_strain;
    s.stress.resize(count);
    for (int i = 0; i < count; ++i) s.displacement.push_back(Vec3(i, 0.1 * i, 1.0 / (i + 1)));
    for (const Vec3& u : s.displacement) s.velocity.push_back(Vec3(u.x(), u.y(), 0));  // zeros are left out
    for (int i = 0; i < count; i += 7) s.stress[i] = {1.0f / static_cast<float>(i + 1), 0, 0, -2, 0, 0};
    return s;
}

TEST_F(States, ManyParticlesSurviveTheChunks) {
    const Snapshot expected = large_snapshot();
    topology_.reference_position.assign(expected.count(), Vec3(1, 2, 3));
    const Snapshot s = read_state(written(expected), topology_);
    EXPECT_TRUE(s.displacement == expected.displacement);
    EXPECT_TRUE(s.velocity == expected.velocity);
    EXPECT_TRUE(s.stress == expected.stress);
    EXPECT_TRUE(s.bond_strain == expected.bond_strain);
}

TEST_F(States, DamagedBytesInsideAnArrayAreNamed) {
    const Snapshot expected = large_snapshot();
    topology_.reference_position.assign(expected.count(), Vec3(1, 2, 3));
    const std::filesystem::path file = written(expected);
    std::string bytes = read_file(file);
    bytes[bytes.size() / 2] ^= 1;  // far from the head, among the compressed numbers
    write_file(file, bytes);
    EXPECT_NE(message_of([&] { read_state(file, topology_); }).find("000000.hdf: "), std::string::npos);
}

TEST_F(States, TwoWritesOfTheSameGiveTheSameBytes) {
    const std::string topology_before = read_file(folder_.path() / "topology.hdf");
    const std::string before = read_file(written(example::snapshot(20)));
    ASSERT_FALSE(before.empty());
    std::filesystem::remove(state_file(folder_.path(), 20));
    // A second apart: HDF5 would store the time of writing, in whole seconds.
    std::this_thread::sleep_for(std::chrono::milliseconds(1001));
    write_topology(folder_.path(), topology_);
    EXPECT_TRUE(read_file(written(example::snapshot(20))) == before);
    EXPECT_TRUE(read_file(folder_.path() / "topology.hdf") == topology_before);
}

TEST_F(States, ExtentIsThatOfTheState) {
    const RunReader::Extent extent = read_extent(written(example::snapshot(30)));
    // Positions: X + u with u = 0.3 / 3 of the second particle and twice that of the third.
    EXPECT_EQ(extent.low, Vec3(0, 1.0 / 3 - 0.3 / 3 * 1e-9, 0));
    EXPECT_EQ(extent.high, Vec3(2 + 2 * (0.3 / 3), 1.0 / 3, 0));
    EXPECT_EQ(extent.range.at("damage"), (std::array<float, 2>{0, 1}));
    EXPECT_EQ(extent.range.at("bond_strain"), (std::array<float, 2>{-0.1f, 1.0f / 3}));
    EXPECT_EQ(extent.range.size(), scalar_field_names().size());
}

TEST_F(States, StateWithoutBondsIsWritten) {
    topology_.first.clear();
    topology_.second.clear();
    topology_.rest_length.clear();
    write_topology(folder_.path(), topology_);
    EXPECT_EQ(read_state(written(example::snapshot(0)), topology_).count(), 3);
    EXPECT_TRUE(read_topology(folder_.path()).first.empty());
}

TEST_F(States, TruncatedStateIsNamed) {
    const std::filesystem::path file = written(example::snapshot(10));
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    EXPECT_NE(message_of([&] { read_state(file, topology_); }).find("000010.hdf: "), std::string::npos);
}

TEST_F(States, GarbageInsteadOfAStateIsNamed) {
    const std::filesystem::path file = state_file(folder_.path(), 1);
    write_file(file, "not HDF5 at all");
    EXPECT_NE(message_of([&] { read_state_info(file); }).find("000001.hdf: "), std::string::npos);
}

TEST_F(States, StateOfAnotherRunIsRefused) {
    const std::filesystem::path file = written(example::snapshot(20));
    topology_.reference_position.resize(2);
    EXPECT_NE(message_of([&] { read_state(file, topology_); }).find("expected 2 x 3"), std::string::npos);
    topology_ = example::topology();
    topology_.first.resize(1);
    EXPECT_NE(message_of([&] { read_state(file, topology_); }).find("names bond 1"), std::string::npos);
}

TEST_F(States, TopologyWithAnIndexOutsideIsRefused) {
    topology_.second[1] = 3;
    write_topology(folder_.path(), topology_);
    EXPECT_NE(message_of([&] { read_topology(folder_.path()); }).find("/Hibi/second holds the index 3"),
              std::string::npos);
}

TEST_F(States, UnwritableFolderIsNamed) {
    EXPECT_NE(message_of([&] {
                  write_state(folder_.path() / "none", topology_, example::snapshot(0));
              }).find("none/000000.hdf"),
              std::string::npos);
}

}  // namespace
}  // namespace hibi
