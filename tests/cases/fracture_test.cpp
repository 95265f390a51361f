// Dynamic fracture against experiment, in the scenes as they stand.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/run_monitor.hpp"
#include "scene/read.hpp"

namespace hibi {
namespace {

struct Outcome {
    std::vector<Break> breaks;
    double top_speed = 0, worst_imbalance = 0;
};

Outcome run(const std::string& name) {
    const Scene scene = read_scene(std::string(HIBI_SOURCE_DIR) + "/scenes/" + name);
    Built<2> built = build(scene);
    SimulationIn<2> simulation(std::move(built.model), std::move(built.physics));
    const auto monitor = make_run_monitor(simulation);
    Outcome outcome;
    while (simulation.time() < scene.run.max_time && !simulation.failure()) {
        simulation.step();
        monitor->look();
        outcome.breaks.insert(outcome.breaks.end(), monitor->just_broken().begin(), monitor->just_broken().end());
        if (simulation.steps() % 10 == 0) monitor->row();
    }
    outcome.top_speed = monitor->top_crack_speed();
    outcome.worst_imbalance = monitor->worst_imbalance();
    return outcome;
}

/// Angle to the notch, in degrees, of the crack through the breaks: least squares of x over y, as it is
/// steep.
double angle_of(const std::vector<Vec3>& places) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : places) mean += p / static_cast<double>(places.size());
    double xy = 0, yy = 0;
    for (const Vec3& p : places) {
        xy += (p.x() - mean.x()) * (p.y() - mean.y());
        yy += (p.y() - mean.y()) * (p.y() - mean.y());
    }
    return std::atan2(1, xy / yy) * 180 / std::numbers::pi;
}

// Experiment: about 70 degrees (Kalthoff and Winkler 1988). Rayleigh speed of the steel in plane strain: 2803
// m/s.
TEST(SlowFracture, KalthoffWinklerCracksLeaveTheirNotchesAtSeventyDegrees) {
    const Outcome o = run("kalthoff_winkler.toml");
    std::vector<Vec3> upper, lower;  // the first two thirds of the way to the edge, mirrored onto one side
    for (const Break& b : o.breaks) {
        const double up = b.position.y() - 0.125, down = 0.075 - b.position.y();
        if (up > 0 && up < 0.05) upper.emplace_back(b.position.x(), up, 0);
        if (down > 0 && down < 0.05) lower.emplace_back(b.position.x(), down, 0);
    }
    ASSERT_GT(upper.size(), 100u);
    ASSERT_GT(lower.size(), 100u);
    EXPECT_NEAR(angle_of(upper), 70, 10);
    EXPECT_NEAR(angle_of(lower), 70, 10);
    EXPECT_GT(o.top_speed, 0.3 * 2803);
    EXPECT_LT(o.top_speed, 2803);
    EXPECT_LT(o.worst_imbalance, 0.01);
}

// Rayleigh speed of the glass in plane stress: 3058 m/s.
TEST(SlowFracture, CrackInGlassDividesBelowTheRayleighSpeed) {
    const Outcome o = run("glass_branching.toml");
    int divided = 0;  // slices of a millimetre in which two branches are three millimetres apart or more
    for (int slice = 70; slice < 98; ++slice) {
        std::vector<double> heights;
        for (const Break& b : o.breaks)
            if (std::floor(1000 * b.position.x()) == slice) heights.push_back(b.position.y());
        std::ranges::sort(heights);
        const auto next =
            std::ranges::adjacent_find(heights, [](double a, double b) { return b - a > 0.003; });
        divided += next != heights.end();
    }
    EXPECT_GE(divided, 5);
    EXPECT_GT(o.top_speed, 0.3 * 3058);
    EXPECT_LT(o.top_speed, 3058);
    EXPECT_LT(o.worst_imbalance, 0.01);
}

}  // namespace
}  // namespace hibi
