// What a run takes before its first step, and how much memory: bench_startup [PARTICLES] [INFLUENCE]
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <string>

#include "base/memory.hpp"
#include "simulation/simulation.hpp"
#include "support/plates.hpp"

namespace {

using namespace hibi;

/// VmRSS, VmHWM: what the process has now, and had at most (MB).
double memory(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(name + ":")) return std::strtod(line.c_str() + name.size() + 1, nullptr) / 1024;
    return 0;
}

void report(const char* stage, double particles, double bonds) {
    using Clock = std::chrono::steady_clock;
    static Clock::time_point last = Clock::now();
    static double total = 0;
    const double seconds = std::chrono::duration<double>(Clock::now() - last).count();
    total += seconds;
    fmt::print("{:<40} {:>8.2f} s {:>8.2f} s {:>8.0f} MB", stage, seconds, total, memory("VmRSS"));
    if (particles > 0) fmt::print("   {:.0f} bytes per particle", memory("VmRSS") * 1024 * 1024 / particles);
    if (bonds > 0) fmt::print(", {:.0f} per bond", memory("VmRSS") * 1024 * 1024 / bonds);
    fmt::print("\n");
    last = Clock::now();
}

}  // namespace

int main(int count, char** words) {
    keep_freed_memory();
    const double side = std::round(std::sqrt(count > 1 ? std::atof(words[1]) : 1e6));
    fmt::print("{:<40} {:>10} {:>10} {:>11}\n", "", "stage", "so far", "memory");
    report("start", 0, 0);
    Material m = test::concrete();
    m.break_strain = 0.01;
    Model<2> model;
    model.materials = {m};
    if (count > 2) model.influence = std::atof(words[2]);
    add_body<2>(model, {.name = "plate", .shape = {Box<2>{{0, 0}, {side, side}}}, .spacing = 1});
    report("fill", model.particles.count(), 0);
    connect<2>(model, {{.name = "notch", .points = {{0, side / 2}, {side / 4, side / 2}}}});
    const double particles = model.particles.count(), bonds = model.bonds.count();
    report("neighbours, bonds, notch", particles, bonds);
    SimulationIn<2> simulation(std::move(model), {});
    report("weights, limits, loops, time step", particles, bonds);
    for (int k = 0; k < 20; ++k) simulation.step();
    report("20 steps", particles, bonds);
    fmt::print("{:.0f} particles, {:.0f} bonds, at most {:.0f} MB\n", particles, bonds, memory("VmHWM"));
}
