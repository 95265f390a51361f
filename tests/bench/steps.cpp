// How fast the solver steps: bond-updates per second, one undirected bond and one whole step each, of a free
// plate with r_e / l0 as given. Run build/release/tests/bench_steps; tests/bench/README.md says how to read
// it.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <string>
#include <thread>

#include "base/hash.hpp"
#include "base/parallel.hpp"
#include "elasticity/bond_kernel.hpp"
#include "simulation/simulation.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

enum class What { plain, breakable, damped_and_heavy, jittered, turned };

SimulationIn<2>& plate_in_motion(int side, double influence, What what) {
    static std::map<std::tuple<int, double, What>, std::unique_ptr<SimulationIn<2>>> known;
    auto& simulation = known[{side, influence, what}];
    if (simulation) return *simulation;
    known.clear();
    Material material = test::concrete();
    if (what == What::breakable) material.break_strain = 0.5;
    Model<2> model;
    model.materials = {material};
    model.influence = influence;
    const double length = side;
    Body<2> body{.name = "plate", .shape = {Box<2>{Vec<2>::Zero(), Vec<2>::Constant(length)}}, .spacing = 1};
    if (what == What::jittered) body.lattice.jitter = 0.1;
    if (what == What::turned) body.lattice.angle = 0.3;
    add_body(model, body);
    connect<2>(model, {});
    for (int i = 0; i < model.particles.count(); ++i)
        for (int a = 0; a < 2; ++a)
            model.particles.initial_velocity[i][a] = 0.02 * (unit_random(mix_bits(2 * i + a)) - 0.5);
    Physics physics;
    if (what == What::damped_and_heavy) {
        physics.gravity = Gravity{Vec3(0, -9.81, 0)};
        physics.damping = Damping{.rate = 0.01};
    }
    auto& place = known[{side, influence, what}];
    place = std::make_unique<SimulationIn<2>>(std::move(model), physics);
    return *place;
}

void step(benchmark::State& state, What what) {
    const int side = static_cast<int>(std::lround(std::sqrt(static_cast<double>(state.range(0)))));
    set_threads(static_cast<int>(state.range(2)));
    SimulationIn<2>& simulation = plate_in_motion(side, static_cast<double>(state.range(1)) / 1000, what);
    for (auto _ : state) simulation.step();
    const auto steps = static_cast<double>(state.iterations());
    state.counters["bond-updates/s"] =
        benchmark::Counter(steps * simulation.model().bonds.count(), benchmark::Counter::kIsRate);
    // Both loops, unwatched and deep inside: 10 and 16 for each of a bond's two ends
    // (src/elasticity/kernel/loops.cpp).
    state.counters["flop/s"] =
        benchmark::Counter(52 * steps * simulation.model().bonds.count(), benchmark::Counter::kIsRate);
    state.counters["ns/particle-step"] =
        benchmark::Counter(steps * simulation.model().particles.count() * 1e-9,
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// 1, 2, 4 ... as far as there are cores.
void add_threads(benchmark::internal::Benchmark* bench, int particles, int re) {
    for (unsigned threads = 1; threads <= std::thread::hardware_concurrency(); threads *= 2)
        bench->Args({particles, re, static_cast<int>(threads)});
}

void sizes(benchmark::internal::Benchmark* bench) {
    bench->ArgNames({"particles", "re", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond);
    for (const int re : {2100, 3015, 4100})
        for (const int particles : {1'000, 10'000, 100'000, 1'000'000}) add_threads(bench, particles, re);
}

void one_size(benchmark::internal::Benchmark* bench) {
    bench->ArgNames({"particles", "re", "threads"})->UseRealTime()->Unit(benchmark::kMillisecond);
    add_threads(bench, 100'000, 3015);
}

BENCHMARK_CAPTURE(step, plain, What::plain)->Apply(sizes);
BENCHMARK_CAPTURE(step, breakable, What::breakable)->Apply(sizes);
BENCHMARK_CAPTURE(step, damped_and_heavy, What::damped_and_heavy)->Apply(one_size);
BENCHMARK_CAPTURE(step, turned, What::turned)->Apply(one_size);
BENCHMARK_CAPTURE(step, jittered, What::jittered)->Apply(one_size);

#if defined(__x86_64__)
using FourDoubles = double __attribute__((vector_size(32)));
using EightDoubles = double __attribute__((vector_size(64)));

/// What one core can do at most: fused multiply-adds without any memory.
#define HIBI_MULTIPLY_AND_ADD(Register)                                        \
    Register sum[10], factor = Register{} + 0.999999, add = Register{} + 1e-6; \
    for (int k = 0; k < 10; ++k) sum[k] = Register{} + k;                      \
    for (int k = 0; k < rounds; ++k)                                           \
        for (Register & s : sum) s = s * factor + add;                         \
    double total = 0;                                                          \
    for (const Register& s : sum) total += s[0];                               \
    return total;
[[gnu::noipa, gnu::target("avx2,fma"), gnu::optimize("fp-contract=fast")]] double peak_of_v3(int rounds) {
    HIBI_MULTIPLY_AND_ADD(FourDoubles)
}
[[gnu::noipa, gnu::target("avx512f"), gnu::optimize("fp-contract=fast")]] double peak_of_v4(int rounds) {
    HIBI_MULTIPLY_AND_ADD(EightDoubles)
}
void peak(benchmark::State& state) {
    constexpr int rounds = 100000;
    const bool v4 = std::string(kernel::loops().level) == "v4";
    for (auto _ : state) benchmark::DoNotOptimize(v4 ? peak_of_v4(rounds) : peak_of_v3(rounds));
    state.counters["flop/s"] =
        benchmark::Counter(static_cast<double>(state.iterations()) * rounds * 10 * (v4 ? 8 : 4) * 2,
                           benchmark::Counter::kIsRate);
}
BENCHMARK(peak);
#endif

}  // namespace
}  // namespace hibi

BENCHMARK_MAIN();
