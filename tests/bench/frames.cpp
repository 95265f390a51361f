// How long a frame takes to draw when nothing else is done, neither PNG nor film: bench_frames DIR...
// of recorded runs, whose own scenes say what is drawn and how large.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "base/memory.hpp"
#include "pictures/run_drawing.hpp"
#include "scene/read.hpp"

int main(int count, char** words) {
    using namespace hibi;
    keep_freed_memory();
    for (int k = 1; k < count; ++k) {
        const std::filesystem::path folder = words[k];
        const Scene scene = read_recorded_scene(folder);
        const RunReader run(folder);
        RunDrawing drawing(scene, run, film_style(scene, run), {});
        Image image(scene.view.width, scene.view.height);
        std::vector<double> times;
        const int frames = static_cast<int>(drawing.plan().time.size());
        for (int frame = 0; frame < frames; ++frame) {
            const auto begin = std::chrono::steady_clock::now();
            drawing.draw(frame, image, std::min(frame + 1, frames - 1));
            times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
        }
        std::ranges::sort(times);
        fmt::print("{:>8} particles, {} x {}: {:.1f} ms per frame (median; fastest {:.1f}, slowest {:.1f})\n",
                   run.topology().reference_position.size(), scene.view.width, scene.view.height,
                   1e3 * times[times.size() / 2], 1e3 * times.front(), 1e3 * times.back());
    }
}
