#include "report/caption.hpp"

#include <gtest/gtest.h>

#include "report/place.hpp"

namespace hibi {
namespace {

Topology plate() {
    Topology t;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 6; ++x) {
            t.reference_position.emplace_back(x + 0.5, y + 0.5, 0);
            t.spacing.push_back(1);
        }
    t.supports = {{"clamp", {0, 6, 12}, {true, true, false}}};
    t.loads = {{"tip", "force", {5, 11, 17}, Vec3(0, -1, 0), true}};
    return t;
}

RunSummary broken() {
    RunSummary s;
    s.title = "Bending & breaking";
    s.version = "0.1.0";
    s.scene_hash = "0123456789abcdef";
    s.particles = 18;
    s.bonds = 50;
    s.broken = 7;
    s.events.first_break = Event{.time = 2, .load = 3e6, .position = Vec3(1, 2.5, 0)};
    s.events.peak_load = s.events.separation = Event{.time = 3, .load = 4e6};
    s.worst_imbalance = 0.004;
    return s;
}

TEST(Caption, TellsWhatHappenedAndHowFarToTrustIt) {
    const Caption c = caption_of(broken(), plate(), "A plate.", "18 particles");
    EXPECT_EQ(c.text,
              "Bending & breaking. A plate. 18 particles. The first bond breaks at t = 2.00 s under 3.00 MN. "
              "The body "
              "separates at t = 3.00 s under 4.00 MN. Energy balance within 0.4 %. Computed and drawn by "
              "hibi 0.1.0, "
              "scene 0123456789ab.");
    RunSummary wrong = broken();
    wrong.trusted = false;
    EXPECT_NE(caption_of(wrong, plate(), "", "").text.find("not to be trusted"), std::string::npos);
}

TEST(Caption, SaysThatNothingBrokeOrThatTheRunStoppedEarly) {
    RunSummary s = broken();
    s.events.first_break.reset();
    s.events.separation.reset();
    const Caption c = caption_of(s, plate(), "", "");
    EXPECT_NE(c.text.find(" No bond breaks. Energy balance"), std::string::npos) << c.text;
    EXPECT_TRUE(c.alternative.ends_with("It is loaded downwards at the right.")) << c.alternative;
    s.stopped = "no equilibrium";
    s.trusted = false;
    EXPECT_NE(caption_of(s, plate(), "", "").text.find("The run stopped early, so it is not to be trusted."),
              std::string::npos);
}

TEST(Place, RoundingIsNoCoordinate) {
    EXPECT_EQ(place_text(Vec3(4.441e-16, 4.25, 0)), "(0, 4.25) m");
    EXPECT_EQ(place_text(Vec3(-1e-15, -3e-6, 0)), "(0, -3e-06) m");
}

TEST(Caption, DescribesThePictureForThoseWhoCannotSeeIt) {
    EXPECT_EQ(caption_of(broken(), plate(), "", "").alternative,
              "A body 6 m wide and 3 m high, drawn as 18 discs. It is clamped at the left. It is loaded "
              "downwards at "
              "the right. The first bond breaks on the upper left, at (1, 2.5) m; 7 of 50 bonds are broken in the end, and "
              "the body is "
              "in pieces.");
}

TEST(Caption, LatexShowsEveryCharacterAsItIs) {
    EXPECT_EQ(latex_escaped("50 % of a_b & {c} #1 $2 x^2 ~ \\ ν"),
              "50 \\% of a\\_b \\& \\{c\\} \\#1 \\$2 x\\textasciicircum{}2 \\textasciitilde{} "
              "\\textbackslash{} $\\nu$");
    const std::string text = latex_snippet(caption_of(broken(), plate(), "", ""), "plate", "movie.mp4");
    EXPECT_NE(text.find("Bending \\& breaking"), std::string::npos);
    EXPECT_NE(text.find("\\label{fig:plate-strip}"), std::string::npos);
}

TEST(Caption, QuartoAndMarkdownKeepQuotesAndStarsInTheirPlaces) {
    RunSummary s = broken();
    s.title = "A *plate* \"of\" glass";
    const Caption c = caption_of(s, plate(), "", "");
    EXPECT_NE(quarto_snippet(c, "x", "movie.mp4").find("{#fig-x-strip fig-alt=\"A body"), std::string::npos);
    EXPECT_NE(quarto_snippet(c, "x", "movie.mp4").find("{{< video movie.mp4 "), std::string::npos);
    EXPECT_NE(quarto_snippet(c, "x", "movie.gif").find("![](movie.gif)"), std::string::npos);
    EXPECT_NE(markdown_snippet(c, "movie.webm").find("(poster.png)](movie.webm)"), std::string::npos);
    EXPECT_NE(markdown_snippet(c, "movie.gif").find("](movie.gif)"), std::string::npos);
    EXPECT_EQ(markdown_snippet(c, "").find("Film"), std::string::npos);
    EXPECT_EQ(latex_snippet(c, "x", "").find("the film"), std::string::npos);
    EXPECT_NE(markdown_snippet(c, "movie.mp4").find("A \\*plate\\*"), std::string::npos);
}

}  // namespace
}  // namespace hibi
