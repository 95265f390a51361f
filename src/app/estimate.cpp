#include "app/estimate.hpp"

#include <chrono>
#include <cmath>

namespace hibi {

Estimate estimate_run(const Scene& scene, const Built<2>& built, Simulation<2>& simulation) {
    Estimate estimate;
    estimate.steps = static_cast<std::int64_t>(std::ceil(scene.run.max_time / simulation.time_step()));

    using Clock = std::chrono::steady_clock;
    const auto begin = Clock::now();
    std::int64_t done = 0;
    double seconds = 0;
    while (done < estimate.steps && seconds < 0.1) {
        simulation.step();
        ++done;
        seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    }
    estimate.solve_seconds =
        seconds / static_cast<double>(std::max<std::int64_t>(1, done)) * static_cast<double>(estimate.steps);

    // Rules of thumb, from runs of 800 to 200 000 particles on two cores.
    const double particles = built.model.particles.count(), bonds = built.model.bonds.count();
    const double pixels = static_cast<double>(scene.view.width) * scene.view.height,
                 frames = scene.movie.frames();
    estimate.draw_seconds = frames * (45e-9 * pixels + 1e-6 * particles);
    estimate.memory = 60e6 + 900 * particles + 250 * bonds + 60 * pixels;
    estimate.disk = 3 * frames * (4000 + 60 * particles) + frames * 0.15 * pixels;
    return estimate;
}

}  // namespace hibi
