#include "report/study.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace hibi {
namespace {

StudyRun run(double spacing, double load, const std::string& criterion = {}) {
    StudyRun r;
    r.parameters = {{"spacing", std::to_string(spacing) + " m", spacing, "m"}};
    r.criterion = criterion;
    r.folder = "out/x";
    RunSummary s;
    s.particles = static_cast<int>(800 / spacing / spacing);
    if (load > 0)
        s.events.first_break = s.events.peak_load = Event{.time = 1, .load = load, .position = Vec3(1, 2, 0)};
    s.seconds["solve"] = 1 / spacing;
    r.summary = s;
    return r;
}

StudyRun failed(double spacing) {
    StudyRun r;
    r.parameters = {{"spacing", "x", spacing, "m"}};
    r.status = 2;
    r.error = "no, \"really\" wrong";
    return r;
}

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> result;
    for (std::size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
        result.push_back(text.substr(at, end - at));
    return result;
}

TEST(Study, CsvAndJsonHoldEveryRunAndLeaveEmptyWhatIsNotKnown) {
    const std::vector<StudyRun> runs{run(2, 4e7), run(1, 0), failed(0.5)};
    const std::vector<std::string> csv = lines(study_csv(runs, "made by x"));
    ASSERT_EQ(csv.size(), 5u);
    EXPECT_TRUE(csv[0].starts_with("# spacing (m), status, first_break_time (s), first_break_load (N)"))
        << csv[0];
    EXPECT_TRUE(csv[0].ends_with("; made by x"));
    EXPECT_TRUE(csv[1].starts_with("spacing,status,first_break_time,first_break_load,")) << csv[1];
    EXPECT_TRUE(csv[2].starts_with("2,done,1,40000000,")) << csv[2];
    EXPECT_TRUE(csv[3].starts_with("1,done,,,")) << csv[3];
    EXPECT_TRUE(csv[4].starts_with("0.5,failed,,")) << csv[4];
    EXPECT_TRUE(csv[4].ends_with(",\"no, \"\"really\"\" wrong\"")) << csv[4];
    const auto json = nlohmann::json::parse(study_json(runs, "T", "hibi sweep"));
    EXPECT_EQ(json["runs"][0]["first_break_load"], 4e7);
    EXPECT_EQ(json["runs"][0]["parameters"]["spacing"]["value"], 2);
    EXPECT_TRUE(json["runs"][1]["first_break_load"].is_null());
    EXPECT_EQ(json["runs"][2]["status"], "failed");
    EXPECT_EQ(json["runs"][2]["error"], "no, \"really\" wrong");
}

TEST(Study, TheTableMarksAPeakThatNothingBrokeUnder) {
    StudyRun whole = run(1, 0);
    whole.summary->events.peak_load = Event{.time = 1, .load = 2e7};
    whole.mode = "nothing breaks";
    const std::vector<std::string> table = lines(study_table({run(2, 4e7), whole}));
    ASSERT_EQ(table.size(), 3u);
    const std::size_t column = table[0].find("peak load");
    ASSERT_NE(column, std::string::npos);
    EXPECT_EQ(table[1].substr(column, 9), "40.00 MN ") << "it broke: the peak is what it bore";
    EXPECT_EQ(table[2].substr(column, 10), "> 20.00 MN") << table[2];
    EXPECT_EQ(table[2].substr(table[0].find("first break"), 2), "- ");
    EXPECT_TRUE(table[2].ends_with("nothing breaks"));
}

TEST(Study, WarnsWhereTheFailureLoadMovesByMoreThanFivePerCent) {
    const Convergence moving = judge_convergence({run(2, 4e7), run(1, 3.7e7), run(0.5, 3.4e7)});
    EXPECT_TRUE(moving.warns);
    EXPECT_NE(moving.caption.find("moves by −8.1 %"), std::string::npos) << moving.caption;
    EXPECT_NE(moving.caption.find("it does not converge"), std::string::npos);
    const Convergence still = judge_convergence({run(2, 4e7), run(1, 3.0e7), run(0.5, 2.9e7)});
    EXPECT_FALSE(still.warns) << "only the two finest count";
    EXPECT_NE(still.caption.find("moves by −3.3 %"), std::string::npos) << still.caption;
}

TEST(Study, WarnsWhereThePeakLoadMovesThoughTheFirstBreakDoesNot) {
    const auto with_peak = [](double spacing, double peak, bool separates) {
        StudyRun r = run(spacing, 4e7);
        r.summary->events.peak_load->load = peak;
        if (separates) r.summary->events.separation = r.summary->events.peak_load;
        return r;
    };
    const Convergence moving = judge_convergence({with_peak(1, 5e7, true), with_peak(0.5, 5.5e7, true)});
    EXPECT_TRUE(moving.warns);
    EXPECT_NE(moving.caption.find("first break moves by 0.0 %, the peak load by +10.0 %, from"),
              std::string::npos)
        << moving.caption;
    EXPECT_FALSE(judge_convergence({with_peak(1, 5e7, true), with_peak(0.5, 5.2e7, true)}).warns);
    const Convergence hanging = judge_convergence({with_peak(1, 5e7, true), with_peak(0.5, 9e7, false)});
    EXPECT_FALSE(hanging.warns) << hanging.caption;
}

TEST(Study, JudgesEachCriterionByItself) {
    const Convergence c =
        judge_convergence({run(2, 4e7, "fixed strain"), run(1, 3e7, "fixed strain"),
                           run(2, 4e7, "fracture energy"), run(1, 4.1e7, "fracture energy")});
    EXPECT_TRUE(c.warns);
    EXPECT_NE(c.caption.find("With fixed strain the load at first break moves by −25.0 %"),
              std::string::npos);
    EXPECT_NE(c.caption.find("With fracture energy the load at first break moves by +2.5 %"),
              std::string::npos);
}

TEST(Study, TheChartHasALinePerSecondParameterAndRisingValues) {
    std::vector<StudyRun> runs;
    for (const double height : {5.0, 10.0})
        for (const double spacing : {2.0, 0.5, 1.0}) {
            runs.push_back(run(spacing, height * 1e6));
            runs.back().parameters.push_back({"height", std::to_string(height), height, "m"});
        }
    const auto chart = study_chart(runs);
    ASSERT_TRUE(chart);
    ASSERT_EQ(chart->lines.size(), 2u);
    EXPECT_EQ(chart->lines[0].x, (std::vector<double>{0.5, 1, 2}));
    EXPECT_EQ(chart->lines[1].y, (std::vector<double>{1e7, 1e7, 1e7}));
    EXPECT_FALSE(study_chart({run(1, 2), failed(2)})) << "one run alone makes no line";
}

TEST(Study, ConvergenceChartsShowLoadAndCostOverTheSpacing) {
    const std::vector<Chart> charts = convergence_charts({run(2, 4e7), run(1, 3e7), failed(0.5)});
    ASSERT_EQ(charts.size(), 2u);
    EXPECT_EQ(charts[0].lines[0].x, (std::vector<double>{2, 1}));
    EXPECT_EQ(charts[0].lines[0].y, (std::vector<double>{4e7, 3e7}));
    EXPECT_EQ(charts[1].lines[0].y, (std::vector<double>{0.5, 1}));
    EXPECT_FALSE(charts[0].note.empty());
}

TEST(Study, TheFailureModeIsThatOfTheFirstBreaks) {
    Topology topology;
    for (int x = 0; x < 10; ++x)
        for (int y = 0; y < 10; ++y) topology.reference_position.emplace_back(x, y, 0);
    RunSummary s;
    EXPECT_EQ(failure_mode(s, topology, {}), "nothing breaks");
    s.events.first_break = Event{.time = 1, .position = Vec3(1, 8, 0)};
    std::vector<Break> breaks(100);
    for (int k = 0; k < 100; ++k) breaks[k].strain = k < 20 ? 0.1 : -0.1;
    EXPECT_EQ(failure_mode(s, topology, breaks), "on the upper left in tension");
    s.events.first_break->position = Vec3(4.5, 8, 0);
    EXPECT_EQ(failure_mode(s, topology, breaks), "in the upper middle in tension") << "not the top fibre";
    s.events.first_break->position = Vec3(1, 8, 0);
    for (Break& b : breaks) b.strain = -0.1;
    EXPECT_EQ(failure_mode(s, topology, breaks), "on the upper left in compression");
}

}  // namespace
}  // namespace hibi
