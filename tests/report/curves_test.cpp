#include "report/curves.hpp"

#include <gtest/gtest.h>

namespace hibi {
namespace {

History history() {
    History h;
    h.load_names = {"tip"};
    for (int k = 0; k <= 10; ++k) {
        HistoryRow row;
        row.time = k;
        row.load = 10.0 * k;
        row.displacement = 0.1 * k;
        row.work = row.elastic = k * k;
        row.kinetic = k > 8 ? 1e6 : 1e-9;  // free flight
        h.rows.push_back(row);
    }
    return h;
}

Events events() {
    Events e;
    e.first_break = Event{.time = 6, .load = 60, .displacement = 0.6};
    e.peak_load = e.separation = Event{.time = 8, .load = 80, .displacement = 0.8};
    return e;
}

TEST(RunCharts, EndWithTheSeparationAndMarkTheEvents) {
    const std::vector<Chart> charts = run_charts(history(), events());
    ASSERT_EQ(charts.size(), 2u);
    EXPECT_EQ(charts[0].lines[0].x.back(), 0.8);
    EXPECT_EQ(charts[0].lines[0].y.back(), 80);
    ASSERT_EQ(charts[0].marks.size(), 2u);
    EXPECT_EQ(charts[0].marks[0].label, "First break");
    EXPECT_EQ(charts[0].marks[1].label, "Peak load, separation");
    EXPECT_EQ(charts[0].marks[1].y, 80);
    EXPECT_EQ(charts[1].marks[0].x, 6);
    EXPECT_FALSE(charts[1].marks[0].y);
}

TEST(RunCharts, ALoadThatEndsWithTheSeparationFallsThere) {
    History released = history();
    for (HistoryRow& row : released.rows)
        if (row.time >= 8) row.load = 0;
    const ChartLine load = run_charts(released, events())[0].lines[0];
    const std::size_t n = load.x.size();
    EXPECT_EQ(load.x[n - 2], load.x[n - 1]);
    EXPECT_EQ(load.y[n - 2], 80);
    EXPECT_EQ(load.y[n - 1], 0);
}

TEST(RunCharts, EnergiesThatNobodyWouldSeeAreLeftOut) {
    const Chart energies = run_charts(history(), events())[1];
    ASSERT_EQ(energies.lines.size(), 2u);  // the kinetic energy becomes large only in flight
    EXPECT_EQ(energies.lines[0].label, "work");
    EXPECT_EQ(energies.lines[1].label, "elastic");
    EXPECT_EQ(run_charts(history(), {})[1].lines.size(), 1u) << "without a separation it is all that counts";
}

TEST(RunCharts, WithoutALoadThereAreOnlyEnergiesAndWithoutRowsNothing) {
    History h = history();
    h.load_names.clear();
    EXPECT_EQ(run_charts(h, {}).size(), 1u);
    h.rows.resize(1);
    EXPECT_TRUE(run_charts(h, {}).empty());
}

}  // namespace
}  // namespace hibi
