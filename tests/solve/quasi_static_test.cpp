#include "solve/quasi_static.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "elasticity/frequency.hpp"
#include "scene/everything.hpp"
#include "scene/read.hpp"
#include "support/plates.hpp"

namespace hibi {
namespace {

/// A cantilever of 10 x 5 particles under a tip load that rises for ever; it breaks at small strains.
struct Cantilever {
    Model<2> model;
    Physics physics;
    double period = 0;

    Cantilever() {
        Material brittle = test::concrete();
        brittle.break_strain = 0.01;
        model = test::plate(10, 5, 4, brittle);
        physics.holds = {
            {"clamp", test::where(model, [](const Vec<2>& X) { return X.x() < 4; }), {true, true, false}}};
        period = 2 * std::numbers::pi / first_frequency(model, SimulationIn<2>(model, physics).held());
    }

    struct Broken {
        double load = 0, periods = 0;
    };
    /// What breaks it first, if the load rises by about static_load in that many periods.
    Broken first_break(double periods, double ratio) const {
        constexpr double about = 5.8e6;
        Physics p = physics;
        const double ramp = 10 * periods * period;
        p.loads = {test::pull(model, test::where(model, [](const Vec<2>& X) { return X.x() > 36; }),
                              {0, -10 * about}, ramp)};
        if (ratio > 0) p.damping = Damping{.ratio = ratio};
        SimulationIn<2> simulation(model, p);
        while (simulation.broken() == 0 && simulation.time() < ramp) simulation.step();
        return {10 * about * simulation.time() / ramp, simulation.time() / period};
    }
};

TEST(RampBias, IsWhatACantileverShows) {
    const Cantilever cantilever;
    // Twice as slow, half the lag: what is left without any.
    const double limit = 2 * cantilever.first_break(60, 0.3).load - cantilever.first_break(30, 0.3).load;
    for (const double ratio : {0.1, 0.3, 1.0})
        for (const double periods : {3.0, 10.0}) {
            const auto broken = cantilever.first_break(periods, ratio);
            const RampBias bias = ramp_bias(ratio, broken.periods);
            EXPECT_NEAR(broken.load / limit - 1, bias.lag, 0.15 * bias.lag + 1.1 * bias.swing)
                << ratio << " " << periods;
        }
    // Undamped it is the swing alone: late at a quarter of a period, early at three.
    for (const double periods : {3.25, 3.75}) {
        const auto broken = cantilever.first_break(periods, 0);
        const double swing = ramp_bias(0, broken.periods).swing, off = broken.load / limit - 1;
        EXPECT_LT(std::abs(off), 1.1 * swing) << periods;
        EXPECT_GT(std::abs(off), 0.5 * swing) << periods;
        EXPECT_EQ(off > 0, periods < 3.5);
    }
}

TEST(RampBias, AtTenPeriodsIsBelowOnePerCent) {
    EXPECT_NEAR(ramp_bias(0.3, 10).lag, 0.00955, 1e-5);
    EXPECT_EQ(fast_ramp("tip", 40, 20.1, 2, 0.3), "");
    EXPECT_EQ(fast_ramp("tip", 40, 10, 2, 0.3),
              "load \"tip\" rises for 5 first periods (of 2.00 s): by then it is 1.9 % above what the body "
              "feels, and "
              "swings by up to 0.0 %; ten periods: ramp = 80 s");
    EXPECT_EQ(fast_ramp("tip", 4, 1, 2, 0),
              "load \"tip\" rises for 0.5 first periods (of 2.00 s): what breaks is dynamic, not static; ten "
              "periods: "
              "ramp = 80 s");
}

TEST(FirstPeriod, IsThatOfTheDampingOrFoundOrNone) {
    const auto period = [](const std::string& before) {
        const Built<2> built = build(parse_scene(before, "s.toml"));
        const SimulationIn<2> simulation(built.model, built.physics);
        const auto found = first_period(built, simulation);
        if (found) {
            EXPECT_NEAR(damping_ratio(simulation, *found), before[0] == 'd' ? 0.3 : 0, 1e-9);
        }
        return found;
    };
    const auto plain = period(small_scene),
               damped = period("damping = \"quasi-static\"\n" + std::string(small_scene));
    ASSERT_TRUE(plain && damped);
    EXPECT_NEAR(*plain, *damped, 1e-8 * *plain);
    std::string free = small_scene;
    free.replace(free.find("hold = [\"x\", \"y\"]"), 17, "hold = [\"x\"]");
    EXPECT_FALSE(period(free));
}

}  // namespace
}  // namespace hibi
