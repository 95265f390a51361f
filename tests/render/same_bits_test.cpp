#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "pictures.hpp"

namespace hibi {
namespace {

using pictures::cracked_plate;

TEST(RendererBits, AreTheSameInEveryFrameAndEveryRenderer) {
    const auto stage = cracked_plate();
    Renderer renderer(stage.view, stage.body);
    Image first, second, between;
    renderer.draw(stage.picture, first);
    Picture2 other = stage.picture;
    for (float& x : other.x) x += 3;
    renderer.draw(other, between);
    renderer.draw(stage.picture, second);
    EXPECT_NE(first.bgra, between.bgra);
    EXPECT_EQ(first.bgra, second.bgra);
    EXPECT_EQ(first.bgra, stage.draw().bgra);
}

TEST(RendererBits, AreTheSameFromOsmesaAndEgl) {
    for (const char* name : {"dark", "light", "print"}) {
        const auto stage = cracked_plate(name);
        Renderer osmesa(stage.view, stage.body, {.backend = GlBackend::osmesa});
        Renderer egl(stage.view, stage.body, {.backend = GlBackend::egl});
        EXPECT_TRUE(osmesa.description().ends_with("OSMesa")) << osmesa.description();
        EXPECT_TRUE(egl.description().ends_with("EGL")) << egl.description();
        EXPECT_TRUE(egl.description().starts_with("llvmpipe")) << egl.description();
        Image a, b;
        for (int turn = 0; turn < 2; ++turn) {  // by turns: each must take the thread back from the other
            osmesa.draw(stage.picture, a);
            egl.draw(stage.picture, b);
            EXPECT_EQ(a.bgra, b.bgra) << name;
        }
    }
}

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

[[noreturn]] void draw_with(const std::string& variable, const std::string& setting,
                            const std::filesystem::path& folder) {
    setenv(variable.c_str(), setting.c_str(), 1);
    const Image image = cracked_plate().draw();
    std::ofstream(folder / (variable + setting), std::ios::binary)
        .write(reinterpret_cast<const char*>(image.bgra.data()), std::ssize(image.bgra));
    std::_Exit(0);
}

// llvmpipe reads its environment once, so every setting needs a process of its own: a death test of the
// "threadsafe" style is one. Its processes run this test from the start, so nothing else may come before
// them.
TEST(RendererBits, AreTheSameForAnyNumberOfThreadsAndVectorWidth) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    const std::string own = "hibi_renderer_bits_test_" + std::to_string(getpid());
    setenv("HIBI_BITS_FOLDER", (std::filesystem::temp_directory_path() / own).c_str(),
           0);  // children keep it
    const std::filesystem::path folder = std::getenv("HIBI_BITS_FOLDER");
    std::filesystem::create_directories(folder);
    const std::pair<const char*, const char*> settings[] = {{"LP_NUM_THREADS", "0"},
                                                            {"LP_NUM_THREADS", "1"},
                                                            {"LP_NUM_THREADS", "2"},
                                                            {"LP_NUM_THREADS", "8"},
                                                            {"LP_NATIVE_VECTOR_WIDTH", "128"}};
    for (const auto& [variable, setting] : settings)
        EXPECT_EXIT(draw_with(variable, setting, folder), testing::ExitedWithCode(0), "");

    const Image here = cracked_plate().draw();
    for (const auto& [variable, setting] : settings)
        EXPECT_TRUE(bytes_of(folder / (std::string(variable) + setting)) == here.bgra)
            << variable << '=' << setting;
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace hibi
