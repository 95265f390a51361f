#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "pictures.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;

/// A copy of shaders/ that a test may spoil.
class Shaders : public testing::Test {
 protected:
    Shaders() {
        fs::remove_all(folder);
        fs::copy(fs::path(HIBI_SOURCE_DIR) / "shaders", folder);
    }
    ~Shaders() override { fs::remove_all(folder); }

    std::string error_of_drawing() const {
        try {
            pictures::cracked_plate().draw({.shaders = folder});
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    }

    fs::path folder = fs::temp_directory_path() / ("hibi_shaders_test_" + std::to_string(getpid()));
};

TEST_F(Shaders, FromAFolderGiveWhatTheBuiltInOnesGive) {
    const auto stage = pictures::cracked_plate();
    EXPECT_EQ(stage.draw({.shaders = folder}).bgra, stage.draw().bgra);
}

TEST_F(Shaders, EditedInAFolderChangeThePicture) {
    const auto stage = pictures::cracked_plate();
    std::ofstream(folder / "particle.frag")
        << "#version 330 core\nout vec4 c;\nvoid main() { c = vec4(1); }\n";
    EXPECT_NE(stage.draw({.shaders = folder}).bgra, stage.draw().bgra);
}

TEST_F(Shaders, MissingFileIsNamed) {
    fs::remove(folder / "bond.frag");
    const std::string error = error_of_drawing();
    EXPECT_NE(error.find((folder / "bond.frag").string()), error.npos) << error;
    EXPECT_NE(error.find("cannot read"), error.npos) << error;
}

TEST_F(Shaders, CompilersLogIsShown) {
    std::ofstream(folder / "crack.vert") << "#version 330 core\nvoid main() { gl_Position = nonsense; }\n";
    const std::string error = error_of_drawing();
    EXPECT_NE(error.find((folder / "crack.vert").string()), error.npos) << error;
    EXPECT_NE(error.find("nonsense"), error.npos) << error;
}

TEST_F(Shaders, LinkersLogIsShown) {
    std::ofstream(folder / "bond.frag") << "#version 330 core\nflat in mat2 half_width;\nout vec4 c;\n"
                                           "void main() { c = vec4(half_width[0], half_width[1]); }\n";
    const std::string error = error_of_drawing();
    EXPECT_NE(error.find("bond.frag"), error.npos) << error;
    EXPECT_NE(error.find("half_width"), error.npos) << error;
}

}  // namespace
}  // namespace hibi
