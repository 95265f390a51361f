#include "record/tables.hpp"

#include <gtest/gtest.h>

#include "record/example.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

using example::message_of;

TEST(Tables, HistoryComesBackBitForBit) {
    const TemporaryFolder folder;
    HistoryRow expected = example::row(0.1);
    expected.load = 0.1 + 0.2;  // 0.30000000000000004: fifteen digits would lose it
    write_file(folder.path() / "h.csv", history_header(example::load_names, 2) + history_line(expected, 2));
    const History history = read_history(folder.path() / "h.csv");
    EXPECT_EQ(history.dimension, 2);
    EXPECT_EQ(history.load_names, example::load_names);
    ASSERT_EQ(history.rows.size(), 1u);
    const HistoryRow& r = history.rows[0];
    EXPECT_EQ(r.time, expected.time);
    EXPECT_EQ(r.load, expected.load);
    EXPECT_EQ(r.displacement, expected.displacement);
    EXPECT_EQ(r.kinetic, expected.kinetic);
    EXPECT_EQ(r.elastic, expected.elastic);
    EXPECT_EQ(r.contact, expected.contact);
    EXPECT_EQ(r.damped, expected.damped);
    EXPECT_EQ(r.released, expected.released);
    EXPECT_EQ(r.work, expected.work);
    EXPECT_EQ(r.imbalance, expected.imbalance);
    EXPECT_EQ(r.broken, expected.broken);
    EXPECT_EQ(r.momentum, expected.momentum);
    EXPECT_EQ(r.loads, expected.loads);
    EXPECT_EQ(r.displacements, expected.displacements);
    EXPECT_EQ(r.crack.length, expected.crack.length);
    EXPECT_EQ(r.crack.tip, expected.crack.tip);
    EXPECT_EQ(r.crack.speed, expected.crack.speed);
    EXPECT_EQ(r.fragments.count, expected.fragments.count);
    EXPECT_EQ(r.fragments.largest, expected.fragments.largest);
    EXPECT_EQ(r.fragments.debris, expected.fragments.debris);
}

TEST(Tables, TipIsAnEmptyCellBeforeTheFirstBreak) {
    const TemporaryFolder folder;
    HistoryRow row = example::row(0.1);
    row.crack.tip.reset();
    const std::string line = history_line(row, 2);
    EXPECT_NE(line.find(",14,,,16,"), std::string::npos) << line;
    write_file(folder.path() / "h.csv", history_header(example::load_names, 2) + line);
    EXPECT_FALSE(read_history(folder.path() / "h.csv").rows.at(0).crack.tip);
}

TEST(Tables, HistoryOfAVersionWithoutCracksIsRead) {
    const TemporaryFolder folder;
    write_file(folder.path() / "h.csv",
               "time,load,displacement,kinetic,elastic,contact,damped,released,work,imbalance,broken,"
               "momentum_x,momentum_y\n1,2,3,4,5,6,7,8,9,10,11,12,13\n");
    const History history = read_history(folder.path() / "h.csv");
    EXPECT_EQ(history.rows.at(0).broken, 11);
    EXPECT_EQ(history.rows.at(0).crack.length, 0);
    EXPECT_FALSE(history.rows.at(0).crack.tip);
}

TEST(Tables, ValueThatMustBeThereIsMissed) {
    const TemporaryFolder folder;
    write_file(folder.path() / "b.csv", breaks_header(2) + "0,1,2,3,,5,6\n");
    EXPECT_NE(
        message_of([&] { read_breaks(folder.path() / "b.csv"); }).find("a value of column \"x\" is missing"),
        std::string::npos);
}

TEST(Tables, HistoryBeginsWithUnitsAndTheNamesScriptsRelyOn) {
    const std::string header = history_header({"tip"}, 3);
    EXPECT_TRUE(header.starts_with("# time (s), load (N), displacement (m), kinetic (J), "));
    EXPECT_TRUE(header.ends_with(
        "\ntime,load,displacement,kinetic,elastic,contact,damped,released,work,imbalance,broken,"
        "momentum_x,momentum_y,momentum_z,load.tip,displacement.tip,"
        "crack_length,crack_tip_x,crack_tip_y,crack_tip_z,crack_speed,fragments,largest_fragment,debris\n"));
}

TEST(Tables, ThirdDimensionIsKept) {
    const TemporaryFolder folder;
    HistoryRow row;
    row.momentum = Vec3(1, 2, 3);
    write_file(folder.path() / "h.csv", history_header({}, 3) + history_line(row, 3));
    const History history = read_history(folder.path() / "h.csv");
    EXPECT_EQ(history.dimension, 3);
    EXPECT_EQ(history.rows.at(0).momentum, row.momentum);
}

TEST(Tables, BreaksComeBackBitForBit) {
    const TemporaryFolder folder;
    const Break expected{1.0 / 3, 1'000'000, 4, 5, Vec3(0.1, 2.0 / 3, 0), -0.1};
    write_file(folder.path() / "b.csv", breaks_header(2) + break_line(expected, 2));
    const std::vector<Break> breaks = read_breaks(folder.path() / "b.csv");
    ASSERT_EQ(breaks.size(), 1u);
    EXPECT_EQ(breaks[0].time, expected.time);
    EXPECT_EQ(breaks[0].bond, expected.bond);
    EXPECT_EQ(breaks[0].first, expected.first);
    EXPECT_EQ(breaks[0].second, expected.second);
    EXPECT_EQ(breaks[0].position, expected.position);
    EXPECT_EQ(breaks[0].strain, expected.strain);
}

TEST(Tables, LineCutShortByAKillIsLeftOut) {
    const TemporaryFolder folder;
    const std::string line = break_line({}, 2);
    write_file(folder.path() / "b.csv", breaks_header(2) + line + line.substr(0, line.size() - 1));
    EXPECT_EQ(read_breaks(folder.path() / "b.csv").size(), 1u);
}

TEST(Tables, DamageIsNamedWithItsLine) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "b.csv";
    write_file(file, breaks_header(2) + "0,1,2,3,4oops,5,6\n");
    EXPECT_NE(message_of([&] { read_breaks(file); }).find("b.csv:3: \"4oops\" in column \"x\" is no number"),
              std::string::npos);
    write_file(file, breaks_header(2) + "0,1\n");
    EXPECT_NE(message_of([&] { read_breaks(file); }).find("b.csv:3: found 2 columns, expected 7"),
              std::string::npos);
    write_file(file, "time\n0\n");
    EXPECT_NE(message_of([&] { read_breaks(file); }).find("column \"bond\" is missing"), std::string::npos);
}

}  // namespace
}  // namespace hibi
