#pragma once
#include <optional>
#include <string>
#include <vector>

#include "film/time_map.hpp"
#include "results/moment.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// Which moment each frame shows, and what it says about it. Frame k of n shows film time k/(n-1) of the
/// duration, so that the first and the last frame are the beginning and the end of the run. Where the map
/// ends before the film does, the last picture stands.
struct FilmPlan {
    TimeMap map;
    double duration = 0;                            ///< of the film (s)
    double flash = 0.6;                             ///< for which a fresh break is bright (s of playback)
    std::vector<double> time{};                     ///< per frame: simulated (s)
    std::vector<std::optional<EventName>> event{};  ///< on the first frame at or after it, the most telling
    std::vector<std::vector<EventName>> events{};   ///< all of a frame
    int poster = 0;  ///< the frame that tells most: the crack long, the body not yet in two

    /// Times and events of so many frames, from the map. The last frame shows `end` to the last bit.
    void set_frames(int frames, const Events& happened, double end);

    /// The event whose label stands in the picture, for a while after it happened, and how strongly (0..1).
    struct Label {
        std::string text;
        double strength = 1;
    };
    std::optional<Label> label(int frame) const;
    /// Playback speed at a frame relative to the fastest of the film; below 1 in slow motion.
    double speed(int frame) const;
    /// 1 for a bond that breaks at this film time (s), falling to 0 within the duration of a flash.
    double freshness(double film_time, double broken_at) const;
    /// Smallest step of simulated time between two frames (s); 0 where there is only one.
    double smallest_step() const;
    double film_time(int frame) const;  ///< (s)
};

/// `broken_at` holds the time of failure of every bond, infinity where intact; `begin` and `end` are the
/// times of the first and last recorded state; the last picture holds as the movie says. Slow spans around
/// events that did not happen are left out. Two events in one frame: separation before first break before
/// peak load before start and end.
FilmPlan plan_film(const MovieSpec& movie, const Events& events, const std::vector<double>& broken_at,
                   double begin, double end);

}  // namespace hibi
