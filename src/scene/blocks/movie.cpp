#include "film/encoder.hpp"
#include "scene/blocks/blocks.hpp"

namespace hibi {

namespace {

Block<SlowSpec> slow_keys() {
    Block<SlowSpec> slow("slow", KeyBlock::Form::inner, "One span of slow motion.");
    slow.add("around", &SlowSpec::around, "", "what is seen slowly; a fifth of the span comes before it",
             R"("first_break")", required);
    slow.add("span", &SlowSpec::span, "s", "simulated time", R"("0.5 s")", required, above(0));
    slow.add("rate", &SlowSpec::rate, "", "speed relative to the rest of the film", "0.05", required,
             above(0, "0.1 is ten times as slow as the rest"));
    return slow;
}

/// Rules between the keys of [movie].
void check_movie(const Scene& scene, Problems& problems) {
    const MovieSpec& movie = scene.movie;
    if (problems.fine("movie/duration") && problems.fine("movie/fps") && movie.duration * movie.fps > 1e6)
        problems.add("movie/duration",
                     fmt::format("[movie] duration: {:.3g} frames are too many", movie.duration * movie.fps));
    if (movie.hold && problems.fine("movie/hold") && problems.fine("movie/duration") &&
        !(*movie.hold >= 0 && *movie.hold < movie.duration))
        problems.add("movie/hold",
                     fmt::format("[movie] hold needs to be shorter than the film, {} s; found {} s",
                                 movie.duration, *movie.hold));
}

}  // namespace

SceneBlock movie_block() {
    Block<MovieSpec> movie("movie", KeyBlock::Form::single, "The film.");
    movie.add("duration", &MovieSpec::duration, "s", "of the whole film, slow parts included", R"("8 s")",
              above(0));
    movie.add("fps", &MovieSpec::fps, "", "frames per second", "30", at_least(1), at_most(240));
    movie.tables(slow_keys(), &MovieSpec::slow,
                 "slow motion; without it the failure gets a third of the film",
                 R"([{ around = "first_break", span = "0.5 s", rate = 0.05 }])");
    movie.bound(
        {"hold", KeyKind::quantity, "s", "how long the last picture stands, within duration", R"("1 s")"},
        [](BlockReader& block, MovieSpec& its) { set(its.hold, block.quantity("hold")); },
        [](WrittenKeys& out, const MovieSpec& its) { out.add("hold", toml_text(its.hold_seconds())); },
        by_default("a twelfth of duration"));
    movie.add("flash", &MovieSpec::flash, "s", "playback time for which a fresh break is bright", R"("1 s")",
              above(0));
    movie.add("poster", &MovieSpec::poster, "", "moment of poster.png", R"("peak_load")",
              by_default("two thirds of the breaks up to separation"));
    movie.add("formats", &MovieSpec::formats, "",
              "of the film: movie.mp4, ...; the size of a gif is at most 960 pixels and 15 frames per "
              "second",
              R"(["mp4", "gif"])", one_of(film_formats()));
    movie.bound(
        {"gif_limit", KeyKind::quantity, "", "MB; a gif becomes smaller, then slower, until it holds", "4"},
        [](BlockReader& block, MovieSpec& its) {
            if (const auto megabytes = block.quantity("gif_limit")) its.gif_limit = 1e6 * *megabytes;
        },
        [](WrittenKeys& out, const MovieSpec& its) { out.add("gif_limit", toml_text(its.gif_limit / 1e6)); });
    SceneBlock result = single_block(movie, &Scene::movie);
    result.checks.push_back(check_movie);
    return result;
}

}  // namespace hibi
