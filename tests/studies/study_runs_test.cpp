#include "studies/study_runs.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "base/process.hpp"
#include "breaking/plane_fracture.hpp"
#include "scene/everything.hpp"
#include "studies/converge.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;

TEST(Grid, ValuesAreSplitAtCommasOutsideOfBrackets) {
    EXPECT_EQ(split_values("1,2 m,max(1, 2)"), (std::vector<std::string>{"1", "2 m", "max(1, 2)"}));
    EXPECT_THROW(split_values("1,,2"), std::invalid_argument);
    EXPECT_THROW(read_grid({"spacing"}), std::invalid_argument);
    EXPECT_THROW(read_grid({"a=1", "a=2"}), std::invalid_argument);
}

TEST(Grid, HasEveryCombinationUnderANameOfItsOwn) {
    const std::vector<StudyPoint> points = grid_points("s.toml", read_grid({"a=1,2", "b=x y,x/y"}));
    ASSERT_EQ(points.size(), 4u);
    EXPECT_EQ(points[1].overrides, (Overrides{{"a", "1"}, {"b", "x/y"}}));
    EXPECT_EQ(points[2].overrides, (Overrides{{"a", "2"}, {"b", "x y"}}));
    EXPECT_EQ(points[0].name, "a=1,b=xy");
    EXPECT_EQ(points[1].name, "a=1,b=x_y");
    const std::vector<StudyPoint> alike = grid_points("s.toml", read_grid({"a=1 m,1m"}));
    EXPECT_EQ(alike[0].name, "a=1m");
    EXPECT_EQ(alike[1].name, "a=1m_2");
}

TEST(Grid, TheSameQuantityIsTheSamePointHoweverItIsWritten) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "s.toml";
    std::string scene = small_scene;
    scene.replace(scene.find("[params]"), 8, "[params]\nramp = \"40 s\"\nforce = \"6 MN\"\nshare = 0.5");
    std::ofstream(file) << scene;
    const auto names = [&](const std::vector<std::string>& texts) {
        std::vector<std::string> list;
        for (const StudyPoint& p : distinct_points(grid_points(file, read_grid(texts))))
            list.push_back(p.name);
        return list;
    };
    using Names = std::vector<std::string>;
    EXPECT_EQ(names({"ramp=0.4,0.4 s,400ms,40 s/100,4"}), (Names{"ramp=0.4s", "ramp=4s"}));
    EXPECT_EQ(names({"ramp=400ms"}), (Names{"ramp=0.4s"}));
    EXPECT_EQ(names({"force=6e6,6000 kN,-7 MN,2*3 MN"}), (Names{"force=6MN", "force=-7MN"}));
    EXPECT_EQ(names({"share=0.50,.5,1/2,0.25"}), (Names{"share=0.5", "share=0.25"}));
    EXPECT_EQ(names({"spacing=2,4 m", "ramp=1 s,1"}), (Names{"spacing=2m,ramp=1s", "spacing=4m,ramp=1s"}));
    // What makes no scene keeps its name: it is told with all other mistakes.
    EXPECT_EQ(names({"spacing=3m,2m,2 m"}), (Names{"spacing=3m", "spacing=2m"}));
}

TEST(Process, TellsHowAProgramEnded) {
    EXPECT_EQ(run_process({"true"}).status, 0);
    const ProcessEnd end = run_process({"sh", "-c", "echo said >&2; echo unsaid; exit 3"});
    EXPECT_EQ(end.status, 3);
    EXPECT_EQ(end.error_output, "said\n");
    EXPECT_EQ(run_process({"sh", "-c", "kill -9 $$"}).status, 128 + 9);
    EXPECT_THROW(run_process({"no-such-program-anywhere"}), std::runtime_error);
    EXPECT_TRUE(fs::exists(this_program()));
}

TEST(InParallel, DoesEverythingOnceAndTellsOfTheFirstError) {
    std::vector<int> done(100);
    int told = 0;
    in_parallel(
        100, 3, [&](int k) { ++done[k]; }, [&] { ++told; });
    EXPECT_EQ(done, std::vector<int>(100, 1));
    EXPECT_EQ(told, 100);
    EXPECT_THROW(in_parallel(
                     5, 2,
                     [](int k) {
                         if (k == 1) throw std::runtime_error("no");
                     },
                     [] {}),
                 std::runtime_error);
}

TEST(Study, AFolderOfOtherThingsIsRefused) {
    const TemporaryFolder folder;
    EXPECT_NO_THROW(require_study_folder(folder.path() / "new", false));
    EXPECT_NO_THROW(require_study_folder(folder.path(), false));
    std::ofstream(folder.path() / "precious.txt") << "x";
    EXPECT_THROW(require_study_folder(folder.path(), false), std::runtime_error);
    EXPECT_NO_THROW(require_study_folder(folder.path(), true));
    std::ofstream(folder.path() / "sweep.json") << "{}";
    EXPECT_NO_THROW(require_study_folder(folder.path(), false));
}

TEST(Converge, TheOtherCriterionHasTheSameLimitAtTheCoarsestSpacing) {
    Scene scene;
    scene.materials = {{.name = "m", .youngs_modulus = 2.1e8, .break_strain = 0.1}};
    const Scene energy = with_other_criterion(scene, 4);
    ASSERT_TRUE(energy.materials[0].fracture_energy && !energy.materials[0].break_strain);
    const auto limit = [&](double l0) {  // of nearest neighbours
        return fracture_strain(energy.materials[0], scene.assumption, scene.influence, l0, l0);
    };
    EXPECT_NEAR(limit(4), 0.1, 1e-12);
    EXPECT_NEAR(limit(1), 0.2, 1e-12);
    const Scene back = with_other_criterion(energy, 4);
    EXPECT_NEAR(*back.materials[0].break_strain, 0.1, 1e-12);
    EXPECT_FALSE(back.materials[0].fracture_energy);
}

}  // namespace
}  // namespace hibi
