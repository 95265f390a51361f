#include "pictures/film_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hibi {
namespace {

Events events() {
    Events e;
    e.first_break = Event{.time = 1.0};
    e.peak_load = Event{.time = 1.2};
    e.separation = Event{.time = 1.5};
    e.end = 2;
    return e;
}

MovieSpec two_seconds() {
    MovieSpec movie;
    movie.duration = 2;
    movie.fps = 25;
    movie.hold = 0;
    return movie;
}

int frame_of(const FilmPlan& plan, EventName name) {
    return static_cast<int>(std::ranges::find(plan.event, std::optional(name)) - plan.event.begin());
}

TEST(FilmPlan, BeginsAndEndsWithTheRunAndHasTheOrderedNumberOfFrames) {
    const FilmPlan plan = plan_film(two_seconds(), events(), {}, 0, 2);
    ASSERT_EQ(plan.time.size(), 50u);  // 2 s at 25 frames per second
    EXPECT_EQ(plan.time.front(), 0);
    EXPECT_EQ(plan.time.back(), 2);
    EXPECT_TRUE(std::ranges::is_sorted(plan.time));
    EXPECT_EQ(plan.event.front(), EventName::start);
    EXPECT_EQ(plan.event.back(), EventName::end);
}

TEST(FilmPlan, AnEventBelongsToTheFirstFrameAtOrAfterIt) {
    const FilmPlan plan = plan_film(two_seconds(), events(), {}, 0, 2);
    for (const auto& [name, time] : {std::pair(EventName::first_break, 1.0),
                                     {EventName::peak_load, 1.2},
                                     {EventName::separation, 1.5}}) {
        const int frame = frame_of(plan, name);
        ASSERT_LT(frame, 50) << to_string(name);
        EXPECT_GE(plan.time[frame], time);
        EXPECT_LT(plan.time[frame - 1], time);
    }
}

TEST(FilmPlan, EventsThatDidNotHappenAreLeftOut) {
    Events none;
    none.end = 2;
    MovieSpec movie = two_seconds();
    movie.slow = {{{EventName::first_break, 0}, 0.5, 0.05}};
    const FilmPlan plan = plan_film(movie, none, {}, 0, 2);
    EXPECT_EQ(frame_of(plan, EventName::first_break), 50);
    for (int k = 0; k < 50; ++k) {
        EXPECT_FALSE(plan.label(k));
        EXPECT_DOUBLE_EQ(plan.speed(k), 1);
    }
    EXPECT_EQ(plan.poster, 49);
}

TEST(FilmPlan, ALoadUnderWhichNothingBreaksHasNoPeakToBeShown) {
    Events e = events();
    e.first_break.reset();
    e.separation.reset();
    const FilmPlan plan = plan_film(two_seconds(), e, {}, 0, 2);
    EXPECT_EQ(frame_of(plan, EventName::peak_load), 50);
}

TEST(FilmPlan, ASlowSpanBeginsAFifthOfItBeforeTheEvent) {
    MovieSpec movie = two_seconds();
    movie.slow = {{{EventName::first_break, 0}, 0.5, 0.05}};
    const FilmPlan plan = plan_film(movie, events(), {}, 0, 2);
    for (int k = 0; k < 50; ++k) {
        const double t = plan.time[k];
        if (std::abs(t - 0.9) < 1e-3 || std::abs(t - 1.4) < 1e-3) continue;  // at the very change
        EXPECT_NEAR(plan.speed(k), t > 0.9 && t < 1.4 ? 0.05 : 1, 1e-9) << t;
    }
    // 0.5 s at a rate of 0.05 take as long as 10 s, the other 1.5 s as they are: 10 / 11.5 of the film.
    const auto slow = std::ranges::count_if(plan.time, [](double t) { return t > 0.9 && t < 1.4; });
    EXPECT_NEAR(static_cast<double>(slow) / 50, 10 / 11.5, 0.03);
}

TEST(FilmPlan, LabelsStandForAWhileAndFade) {
    MovieSpec movie = two_seconds();
    movie.duration = 12;
    const FilmPlan plan = plan_film(movie, events(), {}, 0, 2);
    const int frame = frame_of(plan, EventName::first_break);
    EXPECT_FALSE(plan.label(frame - 1));
    ASSERT_TRUE(plan.label(frame));
    EXPECT_EQ(plan.label(frame)->text, "First break");
    EXPECT_EQ(plan.label(frame)->strength, 1);
    ASSERT_TRUE(plan.label(frame + 20));  // 0.8 s later: inside the last 0.3 of 0.96 s
    EXPECT_LT(plan.label(frame + 20)->strength, 0.6);
    EXPECT_FALSE(plan.label(frame + 25));
}

TEST(FilmPlan, AFlashLastsSixTenthsOfASecondOfPlayback) {
    MovieSpec movie = two_seconds();
    movie.duration = 12;
    const FilmPlan plan = plan_film(movie, events(), {}, 0, 2);
    const int frame = frame_of(plan, EventName::first_break);
    EXPECT_NEAR(plan.freshness(plan.film_time(frame), plan.time[frame]), 1, 1e-9);
    EXPECT_NEAR(plan.freshness(plan.film_time(frame + 7), plan.time[frame]), 1 - 7 / 25.0 / 0.6, 0.01);
    EXPECT_EQ(plan.freshness(plan.film_time(frame + 16), plan.time[frame]), 0);
}

TEST(FilmPlan, ThePosterShowsTheCrackWhenTwoThirdsOfTheBondsAreBroken) {
    // Six bonds up to separation, one later, one never: the fifth breaks at 1.35 s.
    const std::vector<double> broken_at = {1.35, 1.0, 1.4, 1.8, 1.1, 1.2, 1.3, Bonds::intact};
    const FilmPlan plan = plan_film(two_seconds(), events(), broken_at, 0, 2);
    EXPECT_GE(plan.time[plan.poster], 1.35);
    EXPECT_LT(plan.time[plan.poster - 1], 1.35);
}

TEST(FilmPlan, WithoutABreakThePosterShowsThePeakLoad) {
    const FilmPlan plan = plan_film(two_seconds(), events(), {Bonds::intact}, 0, 2);
    EXPECT_GE(plan.time[plan.poster], 1.2);
    EXPECT_LT(plan.time[plan.poster - 1], 1.2);
}

TEST(FilmPlan, TheLastPictureStandsAsLongAsAsked) {
    MovieSpec movie = two_seconds();
    movie.hold = 0.4;
    const FilmPlan plan = plan_film(movie, events(), {}, 0, 2);
    ASSERT_EQ(plan.time.size(), 50u);
    // The frames of the last 0.4 s of 2 s, at 49 intervals for 50 frames.
    EXPECT_EQ(std::ranges::count(plan.time, 2.0), 10);
    EXPECT_EQ(frame_of(plan, EventName::end), 40);
    EXPECT_EQ(plan.film_time(49), 2);
    EXPECT_EQ(plan_film({.duration = 12}, events(), {}, 0, 2).time[275], 2) << "a twelfth, unless asked";
}

TEST(FilmPlan, FlashAndPosterAreTheScenes) {
    MovieSpec movie = two_seconds();
    movie.flash = 1.2;
    movie.poster = Moment{EventName::separation, 0.1};
    const FilmPlan plan = plan_film(movie, events(), {1.0}, 0, 2);
    EXPECT_NEAR(plan.freshness(plan.map.film(1.0) + 0.3, 1.0), 0.75, 1e-9);
    EXPECT_GE(plan.time[plan.poster], 1.6);
    EXPECT_LT(plan.time[plan.poster - 1], 1.6);
}

TEST(FilmPlan, OneFrameIsTheEnd) {
    MovieSpec movie;
    movie.duration = 0.04;
    const FilmPlan plan = plan_film(movie, events(), {}, 0, 2);
    ASSERT_EQ(plan.time.size(), 1u);
    EXPECT_EQ(plan.time[0], 2);
    EXPECT_EQ(plan.smallest_step(), 0);
}

}  // namespace
}  // namespace hibi
