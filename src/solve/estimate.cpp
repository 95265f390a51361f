#include "solve/estimate.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace hibi {

Estimate estimate_run(const Scene& scene, const Built<2>& built, Simulation& simulation) {
    Estimate estimate;
    estimate.steps = static_cast<std::int64_t>(std::ceil(scene.run.max_time / simulation.time_step()));

    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    std::int64_t done = 0;
    double seconds = 0;
    while (done < estimate.steps && seconds < 0.1 && !simulation.collapse()) {
        simulation.step();
        ++done;
        seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    }
    estimate.solve_seconds =
        seconds / static_cast<double>(std::max<std::int64_t>(1, done)) * static_cast<double>(estimate.steps);

    // Rules of thumb from runs of 400 to a million particles: what a frame costs to draw and to keep, and
    // that about one state is kept per frame of the film, and as many again for every slow span; those that
    // wait to be written take at most 256 MB.
    const double particles = built.model.particles.count(), bonds = built.model.bonds.count();
    const double pixels = static_cast<double>(scene.view.width) * scene.view.height;
    const double frames = scene.movie.frames();
    const double states = (1.3 + static_cast<double>(scene.movie.slow.size())) * frames;
    estimate.draw_seconds = frames * (35e-9 * pixels + 0.4e-6 * particles);
    estimate.memory =
        45e6 + 300 * bonds + std::min(150 * 100 * particles, 256e6) + 1000 * particles + 60 * pixels;
    estimate.disk = states * (33e3 + 60 * particles) + frames * 0.24 * pixels;
    return estimate;
}

}  // namespace hibi
