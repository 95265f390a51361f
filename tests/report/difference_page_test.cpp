#include "report/difference_page.hpp"

#include <gtest/gtest.h>

#include "report/html.hpp"

namespace hibi {
namespace {

DifferencePage page() {
    return {
        .title = "a & b",
        .verdict = "worst tile < 4",
        .differs = true,
        .expected_name = "first.png",
        .actual_name = "second.png",
        .pictures = DifferencePage::Pictures{"", "EXPECTED", "ACTUAL", "HEAT", 320, 180, {16, 32, 30, 20}},
        .tables = {{"Pixels",
                    "In steps.",
                    {{"tile", "5 < 6", "3", false}, {"mean", "0", "1", true}, {"largest", "7", "", {}}}},
                   {"Frames", "", {{"0.png", "fine", "", {}}}}}};
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(DifferencePage, ShowsVerdictNamesAndPictures) {
    const std::string html = difference_page(page());
    EXPECT_TRUE(has(html, "<h1>a &amp; b</h1>"));
    EXPECT_TRUE(has(html, "<p class=\"outcome differs\">worst tile &lt; 4</p>"));
    EXPECT_TRUE(has(html, "expected first.png · actual second.png"));
    for (const auto& [name, bytes] :
         {std::pair("expected", "EXPECTED"), {"actual", "ACTUAL"}, {"heat", "HEAT"}}) {
        const std::size_t image = html.find(std::string("<img class=\"") + name + "\"");
        ASSERT_NE(image, std::string::npos) << name;
        EXPECT_EQ(html.find(data_uri("image/png", bytes)), html.find("data:image/png", image)) << name;
    }
    EXPECT_TRUE(has(html, "--wide: 640px"));  // twice as large
    EXPECT_TRUE(has(html, "data-tile=\"16 32 30 20\""));
    EXPECT_TRUE(has(html, "<canvas width=\"240\" height=\"160\""));

    DifferencePage same = page();
    same.differs = false;
    same.pictures->width = 1920;
    same.pictures->tile = {};
    const std::string other = difference_page(same);
    EXPECT_TRUE(has(other, "<p class=\"outcome same\">"));
    EXPECT_TRUE(has(other, "--wide: 1920px"));
    EXPECT_FALSE(has(other, "Worst tile"));
    same.pictures = {};
    EXPECT_FALSE(has(difference_page(same), "<img"));
}

TEST(DifferencePage, MarksWhatDoesNotHoldAndShowsLimitsWhereThereAreSome) {
    const std::string html = difference_page(page());
    EXPECT_TRUE(has(html, "<tr class=\"wrong\"><th scope=\"row\">tile</th><td>5 &lt; 6</td><td>3</td></tr>"));
    EXPECT_TRUE(has(html, "<tr><th scope=\"row\">mean</th><td>0</td><td>1</td></tr>"));
    EXPECT_TRUE(has(html, "<tr><th scope=\"row\">largest</th><td>7</td><td></td></tr>"));
    EXPECT_TRUE(has(html, "<tr><th scope=\"row\">0.png</th><td>fine</td></tr>"));
    EXPECT_EQ(html.find(">Limit<"), html.rfind(">Limit<"));
}

TEST(DifferencePage, AsksNothingOfANetwork) {
    const std::string html = difference_page(page());
    EXPECT_FALSE(has(html, "http://"));
    EXPECT_FALSE(has(html, "https://"));
    for (const std::string attribute : {"src=\"", "href=\""})
        for (std::size_t at = 0; (at = html.find(attribute, at)) != std::string::npos; ++at)
            EXPECT_EQ(html.substr(at + attribute.size(), 5), "data:") << html.substr(at, 80);
}

}  // namespace
}  // namespace hibi
