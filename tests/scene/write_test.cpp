#include <gtest/gtest.h>

#include <filesystem>

#include "scene/everything.hpp"
#include "scene/keys.hpp"
#include "scene/read.hpp"

namespace hibi {
namespace {

/// Everything that reading a scene decides, as one text: written form, and the numbers that come from
/// building it.
void expect_the_same_scene(const Scene& first, const Scene& second) {
    EXPECT_EQ(write_scene(second), write_scene(first));
    const Built<2> a = build(first), b = build(second);
    EXPECT_EQ(a.model.particles.reference_position, b.model.particles.reference_position);
    EXPECT_EQ(a.model.particles.initial_velocity, b.model.particles.initial_velocity);
    EXPECT_EQ(a.model.bonds.first, b.model.bonds.first);
    ASSERT_EQ(a.physics.loads.size(), b.physics.loads.size());
    for (std::size_t l = 0; l < a.physics.loads.size(); ++l) {
        const Load &p = a.physics.loads[l], &q = b.physics.loads[l];
        EXPECT_EQ(p.particles, q.particles);
        EXPECT_EQ(p.direction, q.direction);
        for (int axis = 0; axis < 2; ++axis)
            EXPECT_EQ(p.value[axis](Vec3(61.3, 1.7, 0), 0.3), q.value[axis](Vec3(61.3, 1.7, 0), 0.3));
    }
}

TEST(WriteScene, EveryFileInScenesReadsAndWritesBackTheSame) {
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(HIBI_SOURCE_DIR "/scenes")) {
        if (entry.path().extension() != ".toml") continue;
        ++files;
        const Scene scene = read_scene(entry.path());
        expect_the_same_scene(scene, parse_scene(write_scene(scene), "again"));
    }
    EXPECT_GE(files, 14);
}

TEST(WriteScene, ASceneThatUsesEverythingReadsAndWritesBackTheSame) {
    const Scene scene = parse_scene(everything, "s.toml");
    expect_the_same_scene(scene, parse_scene(write_scene(scene), "again"));
}

TEST(WriteScene, LosesNoKeyThatIsSet) {
    const std::string written = write_scene(parse_scene(everything, "s.toml"));
    const auto holds = [](const std::string& text, const std::string& key) {
        for (std::size_t at = 0; (at = text.find(key + " = ", at)) != std::string::npos; ++at)
            if (at == 0 || text[at - 1] == '\n' || text[at - 1] == ' ') return true;
        return false;
    };
    for (const KeyBlock& block : scene_blocks()) {
        for (const Key& key : block.keys) {
            if (!holds(everything, key.name) || key.name == "line") continue;  // a polyline of two points
            EXPECT_TRUE(holds(written, key.name)) << block.title << " " << key.name;
        }
    }
    // As often as it is set: two moments of loads, one of damping, one of the run.
    std::size_t moments = 0;
    for (std::size_t at = 0; (at = written.find("\nuntil = ", at)) != std::string::npos; ++at) ++moments;
    EXPECT_EQ(moments, 4u);
}

TEST(WriteScene, AnOverrideIsWrittenAsItsEffect) {
    const Scene scene = parse_scene(small_scene, "s.toml", {{"spacing", "2 m"}});
    EXPECT_NE(write_scene(scene).find("\nspacing = 2\n"), std::string::npos);
    EXPECT_NE(write_scene(scene).find("where = \"x < 2 m\""), std::string::npos);
    EXPECT_EQ(write_scene(scene).find("[params]"), std::string::npos);  // it could not be overridden any more
    expect_the_same_scene(scene, parse_scene(write_scene(scene), "again"));
}

TEST(SceneHash, IsThatOfTheExperimentNotOfItsText) {
    const std::string hash = scene_hash(parse_scene(small_scene, "a.toml"));
    std::string other = small_scene;
    other.replace(other.find("\"210 MPa\""), 9, "2.1e8    # Pa");
    other.replace(other.find("x < spacing"), 11, "x < 4 m");
    EXPECT_EQ(scene_hash(parse_scene(other, "b.toml")), hash);
    other.replace(other.find("2.1e8"), 5, "2.2e8");
    EXPECT_NE(scene_hash(parse_scene(other, "b.toml")), hash);
}

}  // namespace
}  // namespace hibi
