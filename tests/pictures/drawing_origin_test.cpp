#include "pictures/drawing_origin.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "image/png.hpp"
#include "pictures/draw.hpp"
#include "pictures/key_frames.hpp"
#include "pictures/run_drawing.hpp"
#include "record/files.hpp"
#include "scene/read.hpp"
#include "support/recorded_cantilever.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

/// Frames of a recorded run whose body stands at a corner, its pictures made by `style`.
template <class Style>
std::vector<Image> frames(const Vec3& corner, Style&& style) {
    const TemporaryFolder folder;
    RecordedCantilever recorded;
    recorded.corner = corner;
    recorded.write(folder.path());
    const RunReader run(folder.path());
    Scene scene = recorded.scene();
    style(scene);
    RunDrawing drawing(scene, run, film_style(scene, run), {});
    std::vector<Image> images;
    for (const int frame : {0, 9, 15, 19}) drawing.draw(frame, images.emplace_back(320, 180));
    images.push_back(StillDrawing(scene, run, "light", 300, 12, {}).draw(1.2));
    images.push_back(HistoryDrawing(scene, run, "light", 300, 12, {}).draw());
    return images;
}

const std::vector<Vec3> far_corners = {
    {1e6, 0, 0}, {-1e6, 0, 0}, {0, 1e6, 0}, {1e9, -1e9, 0}, {1073741824, 1048576, 0}, {123456789, 77, 0}};

template <class Style>
void expect_the_same_pictures(Style&& style) {
    const std::vector<Image> near = frames({0, 0, 0}, [&](Scene& scene) { style(scene, Vec3::Zero()); });
    for (const Vec3& corner : far_corners) {
        const std::vector<Image> far = frames(corner, [&](Scene& scene) { style(scene, corner); });
        for (std::size_t k = 0; k < near.size(); ++k)
            EXPECT_EQ(near[k].bgra, far[k].bgra)
                << "picture " << k << ", corner at " << corner.x() << ", " << corner.y();
    }
}

TEST(DrawingOrigin, ABodyThatIsMovedAsAWholeKeepsItsPictures) {
    expect_the_same_pictures([](Scene&, const Vec3&) {});
}

TEST(DrawingOrigin, SoDoesOneWhoseDisplacementsAreMagnified) {
    expect_the_same_pictures([](Scene& scene, const Vec3&) { scene.view.magnify = 3; });
}

TEST(DrawingOrigin, SoDoesAWindowThatIsMovedWithTheBody) {
    expect_the_same_pictures([](Scene& scene, const Vec3& corner) {
        scene.view.window = {corner.x() - 1, corner.y() - 2, corner.x() + 6, corner.y() + 6};
    });
}

TEST(DrawingOrigin, APreviewAndANotchFarAwayLookAsTheyDoNearby) {
    const TemporaryFolder folder;
    const auto setup = [&](const std::string& name, double corner) {
        const auto at = [&](double x) { return fmt::format("{:.1f} m", corner + x); };
        const std::string text = fmt::format(
            R"(version = 1
title = "Notched"
[material.m]
density = "2000 kg/m^3"
youngs_modulus = "200 MPa"
poissons_ratio = 0.3
break_strain = 0.02
[[body]]
name = "b"
material = "m"
box = [["{0}", "0 m"], ["{1}", "6 m"]]
spacing = "1 m"
[[notch]]
line = [["{0}", "3 m"], ["{2}", "3 m"]]
[[fix]]
where = "y < 1 m"
hold = ["x", "y"]
[[load]]
name = "pull"
where = "y > 5 m"
displacement = ["free", "0.4 m"]
ramp = "1 s"
[run]
max_time = "1.2 s"
[view]
size = [320, 180]
)",
            at(0), at(10), at(4));
        const std::filesystem::path file = folder.path() / (name + ".toml"),
                                    png = folder.path() / (name + ".png");
        write_file(file, text);
        draw_setup(read_and_build(file), png, {});
        return read_png(png).bgra;
    };
    const auto near = setup("near", 0);
    EXPECT_EQ(near, setup("million", 1000000));
    EXPECT_EQ(near, setup("billion", 1000000000));
}

TEST(DrawingOrigin, IsThatOfTheSceneForTheScenesThatComeWithTheProgram) {
    for (const char* rooms : {"scenes", "scenes/verify", "scenes/ci"})
        for (const auto& entry :
             std::filesystem::directory_iterator(std::filesystem::path(HIBI_SOURCE_DIR) / rooms)) {
            if (entry.path().extension() != ".toml") continue;
            const BuiltScene setup = read_and_build(entry.path());
            EXPECT_EQ(drawing_origin(topology_of(setup.scene, setup.built), setup.scene.view.window),
                      Vec3::Zero())
                << entry.path();
        }
}

TEST(DrawingOrigin, FollowsAWindowFarFromTheRestOfTheBody) {
    Topology t;
    t.reference_position = {{0.5, 0.5, 0}, {1e8 + 0.5, 0.5, 0}};
    t.spacing = {1, 1};
    EXPECT_EQ(drawing_origin(t, {}), Vec3::Zero());
    const std::array<double, 4> window{1e8 - 1, -1, 1e8 + 2, 2};
    EXPECT_EQ(drawing_origin(t, window), Vec3(1e8 - 1, -1, 0));
    EXPECT_EQ(drawing_origin({}, window), Vec3::Zero());
}

}  // namespace
}  // namespace hibi
