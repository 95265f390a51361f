#include "report/page.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "record/provenance.hpp"
#include "report/html.hpp"

namespace hibi {
namespace {

PageContent content() {
    PageContent c;
    c.summary.title = "A <b>plate</b> & more </script>";
    c.summary.version = "0.1.0";
    c.summary.scene_hash = "0123456789abcdef0123";
    c.summary.command = "hibi run 'a --> b.toml' -o out/x";
    c.summary.parameters = {{"spacing", "<1 m>"}};
    c.summary.particles = 800;
    c.summary.broken = 3;
    c.summary.events.first_break = Event{.time = 1, .load = 5};
    c.summary.events.peak_load = Event{.time = 1, .load = 5};
    c.history.load_names = {"</script>"};
    for (int k = 0; k < 5000; ++k) {
        HistoryRow row;
        row.time = 0.001 * k;
        row.load = k;
        row.displacement = k;
        row.broken = k >= 1234 ? 3 : 0;
        c.history.rows.push_back(row);
    }
    c.scene = "title = \"</script><script>alert(1)</script>\"";
    c.poster = "poster";
    c.poster_time = 1;
    c.film = "film";
    c.film_type = "video/mp4";
    c.frame_times = {0, 1, 2};
    return c;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++found;
    return found;
}

nlohmann::json data_of(const std::string& page) {
    const std::string open = "id=\"run\">";
    const std::size_t begin = page.find(open) + open.size();
    return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

TEST(ReportPage, ThePosterStandsWhereTheFilmHasNotPlayedYet) {
    PageContent c = content();
    EXPECT_EQ(count(report_page(c), " poster=\"" + data_uri("image/png", "poster") + "\""), 1u);
    EXPECT_EQ(data_of(report_page(c))["poster"], 1.0);
    c.poster = "";
    EXPECT_EQ(count(report_page(c), "poster="), 0u);
    EXPECT_TRUE(data_of(report_page(c))["poster"].is_null());
}

TEST(ReportPage, NothingOfTheSceneBecomesMarkup) {
    const std::string page = report_page(content());
    EXPECT_EQ(count(page, "<script"), 3u);
    EXPECT_EQ(count(page, "</script>"), 3u);
    EXPECT_EQ(page.find("<b>plate"), std::string::npos);
    EXPECT_NE(page.find("A &lt;b&gt;plate&lt;/b&gt; &amp; more"), std::string::npos);
    EXPECT_NE(page.find("&lt;1 m&gt;"), std::string::npos);
    EXPECT_EQ(count(page, "-->"), 1u) << "the comment ends where it should";
}

TEST(ReportPage, AsksForNothingFromOutside) {
    const std::string page = report_page(content());
    for (const char* address : {"src=\"http", "href=\"http", "url(http", "@import", "src=\"//"})
        EXPECT_EQ(page.find(address), std::string::npos) << address;
    EXPECT_NE(page.find("data:video/mp4;base64,ZmlsbQ=="), std::string::npos);
    EXPECT_NE(page.find("data:image/png;base64,cG9zdGVy"), std::string::npos);
}

TEST(ReportPage, SaysWhichCommandMadeItInItsBeginning) {
    const auto found = from_comment(report_page(content()).substr(0, 65536));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->command, content().summary.command);
    EXPECT_EQ(found->title, content().summary.title);
}

TEST(ReportPage, TheHistoryIsThinnedButKeepsTheBreaks) {
    const nlohmann::json data = data_of(report_page(content()));
    const auto times = data["history"]["time"].get<std::vector<double>>();
    EXPECT_LE(times.size(), 1800u);
    EXPECT_EQ(times.back(), 4.999);
    EXPECT_NE(std::ranges::find(times, 1.234), times.end());
    EXPECT_EQ(data["history"]["load"].size(), times.size());
    EXPECT_EQ(data["frames"].size(), 3u);
    EXPECT_EQ(data["charts"].size(), 2u);
    EXPECT_FALSE(data["charts"][0]["of_time"]);
    EXPECT_TRUE(data["charts"][1]["of_time"]);
}

TEST(ReportPage, WarnsInWordsOfARunThatCannotBeTrusted) {
    PageContent c = content();
    EXPECT_NE(report_page(c).find("The run can be trusted."), std::string::npos);
    c.summary.trusted = false;
    c.summary.worst_imbalance = 0.034;
    c.summary.warnings = {"the balance <is> off"};
    const std::string page = report_page(c);
    EXPECT_NE(page.find("<p class=\"verdict bad\"><strong>Do not trust this run.</strong> The energy balance "
                        "is off by 3.4 %"),
              std::string::npos);
    EXPECT_NE(page.find("the balance &lt;is&gt; off"), std::string::npos);
    c.summary.stopped = "step 3: boom";
    EXPECT_NE(report_page(c).find("stopped early</strong>: step 3: boom"), std::string::npos);
}

TEST(ReportPage, SaysThatNothingBroke) {
    PageContent c = content();
    EXPECT_EQ(report_page(c).find("No bond broke"), std::string::npos);
    c.summary.events.first_break.reset();
    EXPECT_NE(
        report_page(c).find("<p class=\"outcome\">No bond broke. Peak load at 1.00 s under 5.00 N.</p>"),
        std::string::npos);
    c.summary.events.peak_load.reset();
    EXPECT_NE(report_page(c).find("<p class=\"outcome\">No bond broke.</p>"), std::string::npos);
    EXPECT_EQ(count(report_page(c), ">did not happen</td>"), 3u);
}

TEST(ReportPage, WithoutAFilmThePosterStandsThere) {
    PageContent c = content();
    c.film.clear();
    const std::string page = report_page(c);
    EXPECT_EQ(page.find("<video"), std::string::npos);
    EXPECT_NE(page.find("data:image/png;base64,cG9zdGVy"), std::string::npos);
    EXPECT_EQ(page.find("id=\"play\""), std::string::npos);
}

}  // namespace
}  // namespace hibi
