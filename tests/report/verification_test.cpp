#include "report/verification.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace hibi {
namespace {

VerifyRow row(const std::string& id, const std::string& variant, double spacing, double error,
              std::optional<double> goal) {
    return {.id = id,
            .title = "Case <" + id + ">",
            .group = "At rest",
            .variant = variant,
            .scene = "verify/" + id,
            .parameter = "rows",
            .resolution = 1 / spacing,
            .spacing = spacing,
            .particles = 100,
            .steps = 2000,
            .quantity = "deflection",
            .unit = "m",
            .measured = 1 + error,
            .reference = 1,
            .error = error,
            .goal = goal,
            .seconds = 1 / spacing,
            .solve_seconds = 0.5,
            .cpu_seconds = 2};
}

/// Error 0.01, 0.0025: second order. The thesis: 0.1, 0.05.
std::vector<VerifyRow> two_variants() {
    return {row("beam", "default", 0.1, 0.01, 0.02), row("beam", "default", 0.05, 0.0025, 0.002),
            row("beam", "thesis", 0.1, 0.1, {}), row("beam", "thesis", 0.05, 0.05, {})};
}

TEST(Verification, PassesWhereTheErrorIsWithinItsGoal) {
    const std::vector<VerifyRow> rows = two_variants();
    EXPECT_EQ(rows[0].pass(), std::optional(true));
    EXPECT_EQ(rows[1].pass(), std::optional(false));
    EXPECT_FALSE(rows[2].pass().has_value());
    VerifyRow failed = rows[0];
    failed.failure = "blew up";
    EXPECT_EQ(failed.pass(), std::optional(false));
    EXPECT_DOUBLE_EQ(rows[0].particle_steps_per_second(), 400000);
    VerifyRow at_rest = rows[0];
    at_rest.method = "static";
    EXPECT_EQ(at_rest.particle_steps_per_second(), 0);
    EXPECT_EQ(verification_verdict(rows), "1 of 2 goals missed: beam at rows = 20.");
    EXPECT_EQ(verification_verdict({rows[0]}), "All 1 goals reached.");
}

TEST(Verification, OrderIsTheSlopeOfErrorOverSpacing) {
    EXPECT_NEAR(*observed_order(two_variants(), "beam", "default"), 2, 1e-12);
    EXPECT_NEAR(*observed_order(two_variants(), "beam", "thesis"), 1, 1e-12);
    EXPECT_FALSE(observed_order(two_variants(), "bar", "default"));
    EXPECT_FALSE(observed_order(
        {row("spin", "default", 0.9, 2e-14, {}), row("spin", "default", 0.5, 1e-14, {})}, "spin", "default"))
        << "rounding has no order";
}

TEST(Verification, JsonHoldsWhatScriptsRelyOn) {
    const nlohmann::json list = nlohmann::json::parse(verification_json(two_variants()));
    ASSERT_EQ(list.size(), 4u);
    EXPECT_EQ(list[1]["case"], "beam");
    EXPECT_EQ(list[1]["variant"], "default");
    EXPECT_EQ(list[1]["particles"], 100);
    EXPECT_EQ(list[1]["resolution"], 20);
    EXPECT_EQ(list[1]["error"], 0.0025);
    EXPECT_EQ(list[1]["goal"], 0.002);
    EXPECT_EQ(list[1]["seconds"], 20);
    EXPECT_EQ(list[1]["pass"], false);
    EXPECT_TRUE(list[2]["goal"].is_null());
    EXPECT_TRUE(list[2]["pass"].is_null());
}

TEST(Verification, CsvHasALineForEachRun) {
    const std::string csv = verification_csv(two_variants(), "hibi");
    EXPECT_EQ(std::ranges::count(csv, '\n'), 6);
    EXPECT_NE(csv.find("beam,default,rows,20,0.05,100,explicit,2000,deflection,m,1.0025,1,0.0025,0.002,false,2"),
              std::string::npos)
        << csv;
}

TEST(Verification, ChartHasALineForEachVariantOfACase) {
    std::vector<VerifyRow> rows = two_variants();
    rows.push_back(row("bar", "default", 0.1, 1e-4, {}));
    const std::vector<Chart> charts = speed_charts(rows);
    ASSERT_EQ(charts.size(), 1u);
    ASSERT_EQ(charts[0].lines.size(), 3u);
    EXPECT_EQ(charts[0].lines[0].x, (std::vector<double>{10, 20}));
    EXPECT_EQ(charts[0].lines[0].y, (std::vector<double>{0.01, 0.0025}));
    EXPECT_FALSE(charts[0].lines[0].dashed);
    EXPECT_TRUE(charts[0].lines[1].dashed);
    EXPECT_EQ(charts[0].lines[1].colour, charts[0].lines[0].colour);
    EXPECT_NE(charts[0].lines[2].colour, charts[0].lines[0].colour);
}

TEST(Verification, PageShowsVerdictAndEveryRunAndAsksNothingOfANetwork) {
    const std::string page =
        verification_page(two_variants(), {}, {"Verification", "1.0", "", "", "hibi verify --quick"});
    EXPECT_NE(page.find("1 of 2 goals missed"), std::string::npos);
    EXPECT_NE(page.find("Case &lt;beam&gt;, thesis variant"), std::string::npos);
    EXPECT_NE(page.find("hibi verify --quick"), std::string::npos);
    EXPECT_EQ(page.find("http:"), page.find("http://www.w3.org")) << "names of XML alone";
    EXPECT_EQ(page.find("https:"), std::string::npos);
    EXPECT_EQ(from_comment(page)->command, "hibi verify --quick");
}

}  // namespace
}  // namespace hibi
