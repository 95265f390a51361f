#include "pictures/picture.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "pictures/run_extents.hpp"
#include "support/recorded_cantilever.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

/// States every 0.05 s; breaks from 1 s to 1.5 s, where the body comes apart.
class Recorded : public ::testing::Test {
 protected:
    void SetUp() override {
        cantilever_.write(folder_.path());
        run_.emplace(folder_.path());
    }
    RecordedCantilever cantilever_;
    TemporaryFolder folder_;
    std::optional<RunReader> run_;
};

using Picture = Recorded;
using WholeRun = Recorded;

TEST_F(Picture, PositionsAndValuesAreInterpolatedBetweenStates) {
    PictureSource source(*run_, View{}, {-0.1, 0.1});
    const Picture2 before = source.at(0.5), after = source.at(0.55), middle = source.at(0.525);
    const int tip = 49;
    ASSERT_NE(before.y[tip], after.y[tip]);
    EXPECT_NEAR(middle.y[tip], (before.y[tip] + after.y[tip]) / 2, 1e-6);
    EXPECT_NEAR(middle.value[40], (before.value[40] + after.value[40]) / 2, 1e-6);
    EXPECT_EQ(source.at(0.5).y, before.y);  // backwards as well
}

TEST_F(Picture, DisplacementsAreMagnified) {
    View view;
    view.magnify = 3;
    const Picture2 big = PictureSource(*run_, view, {0, 1}).at(1),
                   plain = PictureSource(*run_, {}, {0, 1}).at(1);
    const double Y = run_->topology().reference_position[49].y();
    EXPECT_NEAR(big.y[49] - Y, 3 * (plain.y[49] - Y), 1e-5);
}

TEST_F(Picture, ABondIsBrokenFromItsTimeOnAndNotBefore) {
    View view;
    view.bonds = "all";
    PictureSource source(*run_, view, {0, 1});
    const int bonds = static_cast<int>(run_->broken_at().size());
    double last = 0;
    for (const double time : {0.0, 0.999, 1.0, 1.124, 1.125, 1.126, 1.4, 2.0}) {
        const Picture2 picture = source.at(time);
        for (const int b : picture.broken) EXPECT_LE(run_->broken_at()[b], time);
        for (const int b : picture.intact) EXPECT_GT(run_->broken_at()[b], time);
        EXPECT_EQ(static_cast<int>(picture.broken.size() + picture.intact.size()), bonds);
        EXPECT_GE(static_cast<double>(picture.broken.size()), last);
        last = static_cast<double>(picture.broken.size());
    }
    EXPECT_EQ(last, 13);  // between two columns of five: five sides, eight diagonals
}

TEST_F(Picture, IntactBondsAreThereWhenWanted) {
    PictureSource source(*run_, View{}, {0, 1});
    const std::vector<int> before = source.at(0.5).intact;
    ASSERT_FALSE(before.empty());
    EXPECT_TRUE(source.at(0.5, false).intact.empty());
    EXPECT_EQ(source.at(0.5).intact, before);
    EXPECT_EQ(PictureSource(*run_, View{}, {0, 1}).at(0.5).intact, before);
}

TEST_F(WholeRun, IsWorkedOutOncePerReader) {
    int calls = 0;
    const auto count = [&] { return ++calls; };
    EXPECT_EQ(run_->once<int>("calls", count), 1);
    EXPECT_EQ(run_->once<int>("calls", count), 1);
    EXPECT_EQ(run_->once<int>("other calls", count), 2);
    EXPECT_EQ(&detached_at(*run_), &detached_at(*run_));
}

TEST_F(Picture, NearestBondsAreThoseOfTheLatticeSpacing) {
    const Topology& t = run_->topology();
    const std::vector<int> nearest = drawn_bonds(t, "nearest");
    EXPECT_EQ(nearest.size(), 85u);  // 9 x 5 across and 10 x 4 up
    for (const int b : nearest) EXPECT_LT(t.rest_length[b], 1.01);
    EXPECT_EQ(drawn_bonds(t, "all").size(), t.first.size());
    EXPECT_TRUE(drawn_bonds(t, "none").empty());
}

TEST_F(Picture, ReadAheadIsTheSameWhicheverPictureCame) {
    PictureSource ahead(*run_, View{}, {0, 1});
    double expected = 0.1;
    for (const double time : {0.0, 0.1, 0.13, 0.9, 0.9, 0.2, 2.0, 1.99}) {
        const Picture2 plain = PictureSource(*run_, View{}, {0, 1}).at(time);
        const Picture2& picture = ahead.at(time);
        EXPECT_TRUE(picture.x == plain.x && picture.y == plain.y && picture.value == plain.value) << time;
        EXPECT_TRUE(picture.broken == plain.broken) << time;
        ahead.expect(expected);  // often wrongly
        expected += 0.3;
    }
}

TEST_F(Picture, ADamagedStateReadAheadIsAnErrorOfThePictureThatNeedsIt) {
    PictureSource source(*run_, View{}, {0, 1});
    source.at(0);
    std::filesystem::resize_file(run_->states().at(20).file, 100);
    source.expect(run_->states().at(20).time);
    EXPECT_THROW(source.at(run_->states().at(20).time), std::runtime_error);
}

TEST_F(Picture, ValuesOutsideTheRangeAreHeldAtItsEnds) {
    PictureSource source(*run_, View{}, {-0.001, 0.001});
    for (const float v : source.at(1).value) {
        EXPECT_GE(v, 0);
        EXPECT_LE(v, 1);
    }
}

TEST_F(WholeRun, TheWindowHoldsTheBodyUpToSeparationAndNoMore) {
    const std::array<double, 4> window = body_window(*run_, View{});
    View magnified;
    magnified.magnify = 1 + 1e-9;  // the slow way, through all positions
    const std::array<double, 4> slow = body_window(*run_, magnified);
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(window[k], slow[k], 1e-6);
    View far = magnified;
    far.magnify = 1e6;  // the body stays a seventh of the picture, however far it is drawn to move
    const std::array<double, 4> widest = body_window(*run_, far);
    far.magnify = 0;
    const std::array<double, 4> still = body_window(*run_, far);
    const double size = std::max(still[2] - still[0], still[3] - still[1]);
    EXPECT_LE(widest[2] - widest[0], 7 * size);
    EXPECT_GT(widest[3] - widest[1], 2 * size);
    EXPECT_LE(widest[3] - widest[1], 7 * size);
    PictureSource source(*run_, View{}, {0, 1});
    for (const double time : {0.0, 0.7, 1.0, 1.3, 1.5}) {
        const Picture2 picture = source.at(time);
        for (std::size_t i = 0; i < picture.x.size(); ++i) {
            EXPECT_GE(picture.x[i] - 0.5, window[0] - 1e-5);
            EXPECT_GE(picture.y[i] - 0.5, window[1] - 1e-5);
            EXPECT_LE(picture.x[i] + 0.5, window[2] + 1e-5);
            EXPECT_LE(picture.y[i] + 0.5, window[3] + 1e-5);
        }
    }
    EXPECT_LT(source.at(2).y[9], window[1]);  // what falls later leaves the picture
}

TEST_F(WholeRun, TheWindowDoesNotFollowWhatFliesOff) {
    cantilever_.columns = 20;
    cantilever_.rows = 10;
    cantilever_.write(folder_.path());
    const std::array<double, 4> whole = body_window(RunReader(folder_.path()), View{});
    cantilever_.flies = 199;
    cantilever_.write(folder_.path());
    const RunReader run(folder_.path());
    EXPECT_GT(run.extent(30).high.x(), 100);
    EXPECT_EQ(detached_at(run)[199], 0.5);
    EXPECT_FALSE(std::isfinite(detached_at(run)[198]));
    for (int k = 0; k < 4; ++k) EXPECT_NEAR(body_window(run, View{})[k], whole[k], 1);
}

TEST_F(WholeRun, ASignedFieldHasASymmetricRoundRange) {
    // 0.2 * height / rows at the clamp: at most 0.2 * 2 / 5 = 0.08
    EXPECT_NEAR(colour_range(*run_, "bond_strain", true)[0], -0.08, 1e-9);
    EXPECT_NEAR(colour_range(*run_, "bond_strain", true)[1], 0.08, 1e-9);
    EXPECT_EQ(colour_range(*run_, "energy", false)[0], 0);
    EXPECT_NEAR(colour_range(*run_, "energy", false)[1], 4, 1e-9);  // height^2 = 4
    EXPECT_LT(colour_range(*run_, "damage", false)[0],
              colour_range(*run_, "damage", false)[1]);  // zero everywhere
    cantilever_.rows = 4;                                // 0.2 * 1.5 / 4 = 0.075, rounded up
    cantilever_.write(folder_.path());
    EXPECT_NEAR(colour_range(RunReader(folder_.path()), "bond_strain", true)[1], 0.08, 1e-9);
    EXPECT_NEAR(colour_range(RunReader(folder_.path()), "energy", false)[1], 2.5, 1e-9);  // 1.5^2 = 2.25
}

}  // namespace
}  // namespace hibi
