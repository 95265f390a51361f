#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <numeric>

#include "elasticity/tangent.hpp"
#include "scene/everything.hpp"
#include "scene/read.hpp"

namespace hibi {
namespace {

std::string small(const std::string& from, const std::string& to) {
    std::string text = small_scene;
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

Built<2> built_from(const std::string& text) { return build(parse_scene(text, "s.toml")); }

/// The small scene with another load on its right end.
Built<2> with_load(const std::string& load) {
    return built_from(small("where = \"x > 40 m - spacing\"\nforce = [\"0 N\", \"-80 MN\"]", load));
}

TEST(Build, CountsOfTheCantilever) {
    const Built<2> coarse = built_from(small_scene);
    EXPECT_EQ(coarse.model.particles.count(), 50);
    // Pairs of a 10 x 5 lattice nearer than 2.1 spacings: offsets (1,0), (0,1), two diagonals, (2,0), (0,2).
    EXPECT_EQ(coarse.model.bonds.count(), 9 * 5 + 10 * 4 + 2 * 9 * 4 + 8 * 5 + 10 * 3);
    EXPECT_NEAR(std::accumulate(coarse.model.particles.mass.begin(), coarse.model.particles.mass.end(), 0.0),
                2300.0 * 800, 1e-6);
    EXPECT_EQ(coarse.lattice_area_error, std::vector<double>{0.0});
    EXPECT_EQ(build(read_scene(HIBI_SOURCE_DIR "/scenes/bending_fine.toml")).model.particles.count(), 800);
}

TEST(Build, HoldsAndLoadsTakeTheirColumns) {
    const Built<2> built = built_from(small_scene);
    ASSERT_EQ(built.physics.holds.size(), 1u);
    EXPECT_EQ(built.physics.holds[0].particles, (std::vector<int>{0, 10, 20, 30, 40}));
    EXPECT_EQ(built.physics.holds[0].axes, (std::array<bool, 3>{true, true, false}));
    const Load& load = built.physics.loads.at(0);
    EXPECT_EQ(load.particles, (std::vector<int>{9, 19, 29, 39, 49}));
    for (const Vec3& share : load.share) EXPECT_EQ(share, Vec3(0.2, 0, 0));  // equal shares of five
    EXPECT_EQ(load.direction, Vec3(0, -1, 0));
    EXPECT_EQ(load.driven, (std::array<bool, 3>{}));  // a force drives no particle
}

TEST(Build, AFaceCarriesItsWholeAreaAndNothingAcross) {
    const Built<2> built = with_load("face = \"right\"\npressure = \"-2 MPa\"");
    const Load& load = built.physics.loads.at(0);
    Vec3 sum = Vec3::Zero();
    for (const Vec3& area : load.share) sum += area;
    EXPECT_NEAR(sum.x(), 20, 1e-9);  // 20 m high, 1 m thick
    EXPECT_EQ(sum.y(), 0);
    EXPECT_EQ(load.direction, Vec3(1, 0, 0));  // a negative pressure pulls
}

TEST(Build, AForceOnAFaceIsSharedByItsAreas) {
    const Built<2> built = with_load("face = \"top\"\nforce = [\"3 N\", \"-4 N\"]");
    const Load& load = built.physics.loads.at(0);
    double sum = 0, smallest = 0;
    for (const Vec3& share : load.share) {
        sum += share.x();
        smallest = std::min(smallest, share.x());
    }
    EXPECT_NEAR(sum, 1, 1e-12);
    EXPECT_LT(smallest, 0);  // the row behind the face
    EXPECT_NEAR((load.direction - Vec3(0.6, -0.8, 0)).norm(), 0, 1e-12);
    const Topology topology = topology_of(parse_scene(small_scene, "s.toml"), built_from(small_scene));
    EXPECT_EQ(topology.loads[0].particles.size(), 5u);
}

TEST(Build, PressureOnASelectionUsesWholeAreaVectors) {
    const Built<2> built = with_load("body = \"plate\"\npressure = \"1 MPa\"");
    Vec3 sum = Vec3::Zero();
    for (const Vec3& area : built.physics.loads.at(0).share) sum += area;
    EXPECT_LT(sum.norm(), 1e-9);  // a closed surface
}

TEST(Build, PrescribedMotionDrivesItsAxesOnly) {
    const Built<2> built = with_load("where = \"x > 36 m\"\nvelocity = [\"free\", \"-2 m/s\"]");
    const Load& load = built.physics.loads.at(0);
    EXPECT_EQ(load.driven, (std::array<bool, 3>{false, true, false}));
    EXPECT_EQ(load.direction, Vec3(0, -1, 0));
}

TEST(Build, DirectionOfAVaryingLoadIsThatOfItsSumAtFullRamp) {
    // At t = 40 s the force points along (3, 4).
    const Built<2> built =
        with_load("where = \"x > 36 m\"\nforce = [\"3 N*t/(40 s)\", \"8 N - 4 N*t/(40 s)\"]");
    EXPECT_NEAR((built.physics.loads.at(0).direction - Vec3(0.6, 0.8, 0)).norm(), 0, 1e-12);
}

TEST(Build, ALoadThatIsZeroAtFullRampIsReportedAlongItsLargestTotal) {
    const std::vector<std::pair<const char*, Vec3>> loads{
        {"force = [0, \"-9 kN * sin(pi*t/(60 s))\"]", {0, -1, 0}},
        {"force = [0, \"-9 kN * step(t - 50 s)\"]", {0, -1, 0}},
        // Of two equal peaks the first.
        {"force = [0, \"9 kN * sin(2*pi*t/(60 s))\"]", {0, 1, 0}},
        {"displacement = [\"free\", \"-1 m * sin(pi*t/(40 s)) * step(40 s - t)\"]\nramp = \"40 s\"",
         {0, -1, 0}},
        {"velocity = [\"-3 m/s * t/(1 s)\", \"4 m/s * t/(1 s)\"]", {-0.6, 0.8, 0}},
        {"pressure = \"-1 Pa * t/(1 s)\"", {1, 0, 0}},
        // Short, at any time, however it is written; and too fast for any fixed pace.
        {"force = [0, \"-1 N * exp(-((t - 33.123 s)/(1 us))^2)\"]", {0, -1, 0}},
        {"force = [0, \"-1 N * step(t - 7.77 s) * step(7.77001 s - t)\"]", {0, -1, 0}},
        {"force = [0, \"-1 N * step(t/(1 s) - 7.77) * step(7.77001 - t/(1 s))\"]", {0, -1, 0}},
        {"force = [0, \"-1 N * max(0, 1 - abs(t - 20 s)/(1 us))\"]", {0, -1, 0}},
        {"force = [0, \"-1 N * (t*5e6/s) * exp(-t*5e6/s)\"]", {0, -1, 0}},
        {"force = [0, \"-1 N * abs(sin(2*pi*1e6 Hz*t))\"]", {0, -1, 0}},
        // A load that hardly acts at full ramp, and then elsewhere.
        {"force = [\"1 N * exp(-t/(1 s))\", \"-1 kN * step(t - 10 s)\"]", {0, -1, 0}},
        // A pulse that passes over the particles.
        {"force = [0, \"-1 N * step(t - 10 s - x/(100 m/s)) * step(11 s - t)\"]", {0, -1, 0}},
    };
    for (const auto& [load, direction] : loads) {
        const std::string selection =
            std::string(load).starts_with("pressure") ? "face = \"right\"" : "where = \"x > 36 m\"";
        std::string text = small("ramp = \"40 s\"", "");
        const std::string old = "where = \"x > 40 m - spacing\"\nforce = [\"0 N\", \"-80 MN\"]";
        text.replace(text.find(old), old.size(), selection + "\n" + load);
        const Vec3 found = built_from(text).physics.loads.at(0).direction;
        EXPECT_LT((found - direction).norm(), 1e-6) << load << " " << found.transpose();
    }
}

TEST(Build, ARowOfCentresIsSelectedAtEverySize) {
    for (const char* size : {"4 m", "0.1 m", "0.3 m", "0.7 m"}) {
        std::string text = small("spacing = \"4 m\"", std::string("spacing = \"") + size + "\"");
        text.replace(text.find("[\"40 m\", \"20 m\"]"), 16, "[\"10*spacing\", \"5*spacing\"]");
        text.replace(text.find("x < spacing"), 11,
                     "x >= 3*spacing - spacing/2 and x <= spacing/2 + 2*spacing");
        text.replace(text.find("x > 40 m - spacing"), 18,
                     "x > 8*spacing - spacing/2 and not x >= 7*spacing + 3*spacing - spacing/2");
        const Built<2> built = built_from(text);
        EXPECT_EQ(built.physics.holds[0].particles, (std::vector<int>{2, 12, 22, 32, 42})) << size;
        EXPECT_EQ(built.physics.loads[0].particles, (std::vector<int>{8, 18, 28, 38, 48})) << size;
    }
}

TEST(Build, BodiesThatTouchThroughCentresDoNotOverlap) {
    const std::string body = "[[body]]\nmaterial = \"concrete\"\nspacing = 0.1\n";
    const Built<2> built =
        built_from(small("[[fix]]", body + "polygon = [[100, 0], [101, 0], [101, 1]]\n" + body +
                                        "polygon = [[100, 0], [101, 1], [100, 1]]\n[[fix]]"));
    EXPECT_EQ(built.model.particles.count(), 50 + 100);
}

TEST(Build, BodiesStartWithTheirVelocityAndSpin) {
    const Built<2> built = built_from(small(
        "spacing = \"spacing\"", "spacing = \"spacing\"\nvelocity = [\"1 m/s\", \"x/(2 s)\"]\nspin = 3"));
    // Particle 0 at (2 m, 2 m), the centre of mass at (20 m, 10 m): v = (1, 1) + 3 x (8, -18).
    EXPECT_NEAR((built.model.particles.initial_velocity[0] - Vec<2>(1 + 24, 1 - 54)).norm(), 0, 1e-12);
}

TEST(Build, NotchesCutAndAreHandedOnForDrawing) {
    const Built<2> whole = built_from(small_scene);
    const Built<2> cut =
        built_from(small("[[fix]]", "[[notch]]\npolyline = [[20, 20], [20, 15], [24, 11]]\n[[fix]]"));
    EXPECT_GT(cut.model.bonds_cut, 0);
    EXPECT_EQ(cut.model.bonds.count() + cut.model.bonds_cut, whole.model.bonds.count());
    EXPECT_EQ(cut.notches.size(), 2u);
}

/// A bar of 40 x 10 spacings, pulled at both ends with 1 Pa; E = 1 Pa.
std::string bar(const std::string& lattice) {
    return R"scene([material.m]
density = 1
youngs_modulus = 1
poissons_ratio = 0.3
[[body]]
material = "m"
box = [[0, 0], [40, 10]]
spacing = 1
lattice = )scene" +
           lattice + R"scene(
[[load]]
face = "right"
pressure = -1
[[load]]
face = "left"
pressure = -1
[run]
max_time = 1
)scene";
}

struct Pulled {
    double area = 0;    ///< of the right face (m^2)
    double strain = 0;  ///< along the bar, from a straight line through its middle half
};

Pulled pulled(const std::string& lattice) {
    const Built<2> built = built_from(bar(lattice));
    const Particles<2>& particles = built.model.particles;
    const int n = particles.count();
    Pulled result;
    for (const Vec3& share : built.physics.loads[0].share) result.area += share.x();
    Eigen::VectorXd force = Eigen::VectorXd::Zero(2 * n);
    for (const Load& load : built.physics.loads)
        for (std::size_t k = 0; k < load.particles.size(); ++k)
            for (int axis = 0; axis < 2; ++axis) force[2 * load.particles[k] + axis] += load.share[k][axis];
    const auto nearest = [&](const Vec<2>& place) {
        int best = 0;
        for (int i = 0; i < n; ++i)
            if ((particles.reference_position[i] - place).norm() <
                (particles.reference_position[best] - place).norm())
                best = i;
        return best;
    };
    Eigen::SparseMatrix<double> K = tangent(built.model, initial_state(built.model));
    for (const int dof : {2 * nearest({20, 5}), 2 * nearest({10, 5}) + 1, 2 * nearest({30, 5}) + 1})
        K.coeffRef(dof, dof) *= 1e9;
    const Eigen::VectorXd u = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(K).solve(force);
    double xx = 0, ux = 0, x = 0, sum = 0, count = 0;
    for (int i = 0; i < n; ++i) {
        const double X = particles.reference_position[i].x();
        if (std::abs(X - 20) > 10) continue;
        xx += X * X, ux += X * u[2 * i], x += X, sum += u[2 * i], ++count;
    }
    result.strain = (ux - x * sum / count) / (xx - x * x / count);
    return result;
}

TEST(Build, ABarOfATurnedOrJitteredLatticeIsPulledByItsFaces) {
    // The strain misses what the rough sides add to the width or take from it (half a spacing in ten), and
    // what the forces that jitter leaves inside a body under even stress take from its stiffness.
    const std::vector<std::pair<const char*, double>> allowed{
        {"{ angle = 0 }", 1e-3},          {"{ angle = \"15 deg\" }", 0.06}, {"{ angle = \"30 deg\" }", 0.06},
        {"{ angle = \"45 deg\" }", 0.06}, {"{ jitter = 0.1 }", 0.03},       {"{ jitter = 0.2 }", 0.1}};
    for (const auto& [lattice, error] : allowed) {
        const Pulled bar = pulled(lattice);
        EXPECT_NEAR(bar.area, 10, 1e-9) << lattice;
        EXPECT_NEAR(bar.strain, 1, error) << lattice;
        RecordProperty(lattice, fmt::format("{:.4f}", bar.strain));
    }
}

TEST(Build, ADiscIsOffInAreaAndSaysHowMuch) {
    const Built<2> built = built_from(small("[[fix]]",
                                            "[[body]]\nmaterial = \"concrete\"\ndisc = { centre = [100, 0], "
                                            "radius = 10 }\nspacing = 1\n[[fix]]"));
    const int particles = built.model.particles.count() - 50;
    EXPECT_NEAR(built.lattice_area_error[1], particles / (3.14159265358979 * 100) - 1, 1e-12);
    EXPECT_LT(std::abs(built.lattice_area_error[1]), 0.05);
}

TEST(TopologyOf, HoldsWhatIsDrawn) {
    const Scene scene = parse_scene(everything, "s.toml");
    const Built<2> built = build(scene);
    const Topology topology = topology_of(scene, built);
    EXPECT_EQ(topology.body_names.size(), 6u);
    EXPECT_EQ(topology.reference_position.size(), topology.body.size());
    EXPECT_EQ(topology.first, built.model.bonds.first);
    EXPECT_EQ(topology.supports.size(), 2u);
    ASSERT_EQ(topology.loads.size(), 6u);
    EXPECT_EQ(topology.loads[1].kind, "pressure");
    EXPECT_TRUE(topology.loads[1].primary);
    EXPECT_EQ(topology.loads[1].particles.size(), 20u);  // the outermost row of a 10 m side, spacing 0.5 m
    EXPECT_EQ(topology.loads[2].particles.size(), 10u);  // and of a 5 m side
    EXPECT_EQ(topology.notches.size(), 3u);
    EXPECT_EQ(topology.thickness, 0.2);
}

}  // namespace
}  // namespace hibi
