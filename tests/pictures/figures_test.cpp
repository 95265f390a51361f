#include "pictures/figures.hpp"

#include <gtest/gtest.h>

#include <map>

#include "image/png.hpp"
#include "pictures/key_frames.hpp"
#include "record/leftovers.hpp"
#include "support/recorded_cantilever.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;

class Figures : public testing::Test {
 protected:
    Figures() {
        RecordedCantilever cantilever;
        cantilever.write(folder_.path());
        scene_ = cantilever.scene();
    }
    TemporaryFolder folder_;
    Scene scene_;
};

TEST_F(Figures, KeyMomentsAreThoseThatHappenedInOrderAndOnce) {
    const RunReader run(folder_.path());
    scene_.strip.at = {{EventName::separation, 0},  {EventName::start, 0},         {{}, 1.0},
                       {EventName::first_break, 0}, {EventName::separation, 0.25}, {{}, 77}};
    const std::vector<KeyMoment> moments = key_moments(scene_, run);
    ASSERT_EQ(moments.size(), 4u);
    EXPECT_EQ(moments[0].label, "Start");
    EXPECT_EQ(moments[1].label, "First break") << "at the time of 1 s, which has no name";
    EXPECT_EQ(moments[2].label, "Separation");
    EXPECT_EQ(moments[3].label, "Separation + 250 ms");
    EXPECT_DOUBLE_EQ(moments[3].time, 1.75);
    EXPECT_EQ(moments[1].detail.substr(0, 11), "t = 1.00 s,");
}

TEST_F(Figures, EventsAtOneMomentShareAPicture) {
    const RunReader run(folder_.path());
    scene_.strip.at = {{EventName::separation, 0}, {EventName::end, -0.5}};
    const std::vector<KeyMoment> moments = key_moments(scene_, run);
    ASSERT_EQ(moments.size(), 1u);
    EXPECT_EQ(moments[0].label, "Separation, end − 500 ms");
}

TEST_F(Figures, ARunsFolderGetsThemInPrintWidthsWithTheirOriginAndLosesThemAgain) {
    draw_figures(scene_, RunReader(folder_.path()), {});
    const std::map<std::string, int> widths = {{"strip.png", 2008},
                                               {"cracks.png", 2008},
                                               {"curve.png", 2008},
                                               {"figures/strip_print_85mm.png", 1004},
                                               {"figures/cracks_print_170mm.png", 2008},
                                               {"figures/curve_print_85mm.png", 1004}};
    for (const auto& [name, width] : widths) {
        PngText text;
        EXPECT_NEAR(read_png(folder_.path() / name, &text).width, width, 1) << name;
        EXPECT_EQ(text["Title"], "Cantilever");
        EXPECT_EQ(text["Scene hash"], "0123abcd");
    }
    EXPECT_TRUE(fs::exists(folder_.path() / "curve.svg"));
    EXPECT_TRUE(fs::exists(folder_.path() / "figures/curve_print_170mm.svg"));
    remove_pictures(folder_.path());
    for (const auto& [name, width] : widths) EXPECT_FALSE(fs::exists(folder_.path() / name)) << name;
    EXPECT_FALSE(fs::exists(folder_.path() / "figures"));
    EXPECT_TRUE(fs::exists(folder_.path() / "run.json"));
}

TEST_F(Figures, CracksAreColouredByTheTimeOfTheirBreaking) {
    const RunReader run(folder_.path());
    HistoryDrawing drawing(scene_, run, "light", 800, 20, {});
    ASSERT_TRUE(drawing.colours());
    const ColourMap& map = colour_map(drawing.colours()->map);
    const Image image = drawing.draw();
    const auto pixels_of = [&](int entry) {
        int count = 0;
        for (int i = 0; i < image.width * image.height; ++i)
            count += std::abs(image.bgra[4 * i] - map[entry][2]) < 4 &&
                     std::abs(image.bgra[4 * i + 1] - map[entry][1]) < 4 &&
                     std::abs(image.bgra[4 * i + 2] - map[entry][0]) < 4;
        return count;
    };
    EXPECT_GT(pixels_of(0), 20) << "first break";
    EXPECT_GT(pixels_of(255), 20) << "last break";
}

TEST_F(Figures, AThemeChangesTheColoursAndNothingElse) {
    const RunReader run(folder_.path());
    const Image light = StillDrawing(scene_, run, "light", 400, 12, {}).draw(1.2);
    const Image dark = StillDrawing(scene_, run, "dark", 400, 12, {}).draw(1.2);
    EXPECT_EQ(light.width, 400);
    EXPECT_EQ(dark.height, light.height);
    EXPECT_GT(light.pixel(2, 2)[0], 200);
    EXPECT_LT(dark.pixel(2, 2)[0], 60);
}

}  // namespace
}  // namespace hibi
