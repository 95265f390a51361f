#include "studies/compare.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "image/png.hpp"
#include "record/summary.hpp"
#include "scene/read.hpp"
#include "studies/compared_runs.hpp"
#include "support/recorded_cantilever.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Two recorded cantilevers, the second of them ending earlier or with other parameters.
class Compare : public testing::Test {
 protected:
    fs::path write(const std::string& name, const std::map<std::string, std::string>& parameters,
                   const Vec3& corner = Vec3::Zero()) {
        const fs::path folder = folder_.path() / name;
        RecordedCantilever cantilever;
        cantilever.corner = corner;
        cantilever.write(folder);
        Scene scene = cantilever.scene();
        scene.run.max_time = 2;
        scene.movie.duration = 1;
        // A whole scene is not needed to draw; what is written must be readable, though.
        std::ofstream(folder / "scene.toml") << R"(
title = "Cantilever"
[material.concrete]
density = 2300
youngs_modulus = 2.1e8
poissons_ratio = 0.3
break_strain = 0.1
[[body]]
material = "concrete"
box = [[0, 0], [4, 2]]
spacing = 1
[[load]]
where = "x > 3 m"
force = [0, -1]
[run]
max_time = 2
[view]
size = [640, 360]
[movie]
duration = 1
fps = 10
hold = 0
)";
        RunSummary summary = read_summary(folder);
        summary.parameters = parameters;
        write_summary(folder, summary);
        return folder;
    }
    CompareOptions options(std::vector<fs::path> folders) const {
        return {.folders = std::move(folders), .output = folder_.path() / "out", .quiet = true};
    }
    TemporaryFolder folder_;
};

TEST_F(Compare, TellsRunsApartByWhatDiffers) {
    const fs::path a = write("a", {{"spacing", "2m"}, {"height", "5m"}}),
                   b = write("b", {{"spacing", "1m"}, {"height", "5m"}});
    EXPECT_EQ(labels_of({a, b}), (std::vector<std::string>{"spacing = 2m", "spacing = 1m"}));
    EXPECT_EQ(labels_of({a, a}), (std::vector<std::string>{"a", "a"}));
    const fs::path c = write("c", {});
    EXPECT_EQ(labels_of({a, c}), (std::vector<std::string>{"a", "c"}))
        << "same titles, no parameters on one side";
}

TEST_F(Compare, MakesAFilmWithTheFramesOfARunAndIsTheSameTwice) {
    const fs::path a = write("a", {{"spacing", "2m"}}), b = write("b", {{"spacing", "1m"}});
    const auto frames = [&] {
        make_comparison(options({a, b}));
        return Json::parse(std::ifstream(folder_.path() / "out/frames.json"));
    };
    const Json first = frames();
    ASSERT_EQ(first.size(), 10u);
    EXPECT_EQ(first, frames());
    EXPECT_EQ(first.front()["time"], 0.0);
    EXPECT_EQ(first.back()["time"], 2.0);
    EXPECT_TRUE(fs::exists(folder_.path() / "out/movie.mp4"));
    PngText text;
    read_png(folder_.path() / "out/poster.png", &text);
    EXPECT_NE(text["Command"].find("hibi compare"), std::string::npos);
}

TEST_F(Compare, RunsFarFromTheOriginGiveTheSameFilm) {
    const auto frames = [&](const std::string& name, const Vec3& corner) {
        CompareOptions o = options({write(name + "1", {}, corner), write(name + "2", {}, corner)});
        o.labels = {"one", "other"};
        make_comparison(o);
        return Json::parse(std::ifstream(folder_.path() / "out/frames.json"));
    };
    const Json near = frames("near", {0, 0, 0});
    EXPECT_EQ(near, frames("million", {1e6, 0, 0}));
    EXPECT_EQ(near, frames("billion", {1e9, -1e9, 0}));
}

TEST_F(Compare, EqualRunsLookEqualInTheirPanels) {
    const fs::path a = write("a", {}), b = write("b", {});
    CompareOptions o = options({a, b});
    o.columns = 2;
    o.labels = {"same", "same"};
    make_comparison(o);
    const Image image = read_png(folder_.path() / "out/frames/000005.png");
    // The bodies repeat at a distance of one panel: find it as the shift that leaves fewest differences among
    // the pixels of the left panel that are not background.
    const auto different = [&](int shift) {
        int count = 0;
        for (int y = 110; y < 250; ++y)
            for (int x = 40; x < 200; ++x) {
                const std::uint8_t *p = image.pixel(x, y), *q = image.pixel(x + shift, y);
                count += std::abs(p[0] - q[0]) + std::abs(p[1] - q[1]) + std::abs(p[2] - q[2]) > 0;
            }
        return count;
    };
    int best = different(150);
    for (int shift = 150; shift < 330; ++shift) best = std::min(best, different(shift));
    EXPECT_EQ(best, 0);
}

TEST_F(Compare, AlignedClocksAgreeAtTheEvent) {
    const fs::path a = write("a", {}), b = write("b", {});
    CompareOptions o = options({a, b});
    o.align = EventName::first_break;
    make_comparison(o);
    const Json frames = Json::parse(std::ifstream(folder_.path() / "out/frames.json"));
    EXPECT_EQ(frames.front()["time"], -RecordedCantilever().first_break);
    for (const Json& frame : frames)
        if (frame["event"] == "first_break") {
            EXPECT_GE(frame["time"].get<double>(), 0);
        }
}

TEST_F(Compare, RefusesWhatCannotBeCompared) {
    const fs::path a = write("a", {}), b = write("b", {});
    EXPECT_THROW(make_comparison(options({a})), std::invalid_argument);
    EXPECT_THROW(make_comparison(options({a, folder_.path()})), std::invalid_argument);
    CompareOptions labels = options({a, b});
    labels.labels = {"one"};
    EXPECT_THROW(make_comparison(labels), std::invalid_argument);
    labels.labels = {"one", "🔨"};
    EXPECT_THROW(make_comparison(labels), std::invalid_argument);
    EXPECT_FALSE(fs::exists(folder_.path() / "out")) << "before anything is drawn";
    RunSummary summary = read_summary(b);
    summary.events.separation.reset();
    write_summary(b, summary);
    CompareOptions align = options({a, b});
    align.align = EventName::separation;
    EXPECT_THROW(make_comparison(align), std::invalid_argument);
    fs::create_directories(folder_.path() / "out");
    std::ofstream(folder_.path() / "out/precious.txt") << "x";
    EXPECT_THROW(make_comparison(options({a, b})), std::runtime_error);
    EXPECT_TRUE(fs::exists(folder_.path() / "out/precious.txt"));
}

}  // namespace
}  // namespace hibi
