#include "render/context.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <stdexcept>
#include <string>

#include "pictures.hpp"

namespace hibi {
namespace {

TEST(Context, MissingLibraryIsNamedWithItsPackage) {
    try {
        Library("libhibi-has-none.so.1", "libhibi-none");
        FAIL();
    } catch (const std::runtime_error& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("libhibi-has-none.so.1"), text.npos) << text;
        EXPECT_NE(text.find("package libhibi-none"), text.npos) << text;
    }
}

TEST(Context, DescriptionNamesRendererVersionAndLibrary) {
    const auto stage = pictures::cracked_plate();
    const std::string text = Renderer(stage.view, stage.body).description();
    EXPECT_TRUE(text.starts_with("llvmpipe (LLVM ")) << text;
    EXPECT_NE(text.find(std::getenv("LP_NATIVE_VECTOR_WIDTH") + std::string(" bits)")), text.npos) << text;
    EXPECT_NE(text.find(", Mesa "), text.npos) << text;
    EXPECT_TRUE(text.ends_with(", OSMesa")) << text;
}

}  // namespace
}  // namespace hibi
