// Defects put into pictures at the size of a test, which the tolerant rule must catch, and what rounds
// differently on other processors, which it must let pass. Prints the table of scenes/TESTING.md:
//     build/release/tests/test_cases --gtest_filter='Slow*Defects.*'
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "image/difference.hpp"
#include "picture_tests/reference.hpp"
#include "pictures/run_drawing.hpp"
#include "pictures/run_extents.hpp"
#include "record/files.hpp"
#include "scene/read.hpp"
#include "support/call.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Defect {
    const char* name;
    PixelDifference difference;
    bool seen = true;  ///< the picture shows it at all
};

/// The body of a recorded run at one moment, without anything beside it, so that it can be spoilt.
class Body {
 public:
    Body(const Scene& scene, const RunReader& run, double time, int width, int height)
        : style_(style_of(scene, run, width, height)),
          renderer_(style_.view, run.topology()),
          picture_(PictureSource(run, style_.view, style_.range).at(time)),
          topology_(run.topology()) {
        const auto box = body_window(run, style_.view);
        const double w = style_.view.width, h = style_.view.height;
        picture_.camera =
            Camera2::fit(box[0], box[1], box[2], box[3], {0.1 * w, 0.15 * h, 0.6 * w, 0.75 * h});
        // At its brightest, as it is when a film shows it first.
        if (!picture_.freshness.empty()) picture_.freshness.back() = 1;
    }

    const Picture2& picture() const { return picture_; }
    Image draw(const Picture2& picture) {
        Image image(style_.view.width, style_.view.height);
        renderer_.draw(picture, image);
        return image;
    }
    int middle_particle() const {
        const Camera2& c = picture_.camera;
        int nearest = 0;
        double best = 1e300;
        for (std::size_t i = 0; i < picture_.x.size(); ++i) {
            const double d = std::hypot(picture_.x[i] - c.centre_x, picture_.y[i] - c.centre_y);
            if (d < best) best = d, nearest = static_cast<int>(i);
        }
        return nearest;
    }
    /// Bonds fade out where particles lie closer than this.
    bool shows_bonds() const { return picture_.camera.scale * topology_.spacing[0] >= 24; }
    bool touches(int bond, int particle) const {
        return topology_.first[bond] == particle || topology_.second[bond] == particle;
    }

 private:
    static DrawingStyle style_of(Scene scene, const RunReader& run, int width, int height) {
        scene.view.width = width;
        scene.view.height = height;
        return film_style(scene, run);
    }

    DrawingStyle style_;
    Renderer renderer_;
    Picture2 picture_;
    const Topology& topology_;
};

/// A block in the middle of the picture, a third of it wide and high, one pixel further to the right.
Image shifted(const Image& image) {
    Image moved = image;
    for (int y = image.height / 3; y < 2 * image.height / 3; ++y)
        std::copy_n(image.pixel(image.width / 3, y), 4 * (image.width / 3),
                    moved.pixel(image.width / 3 + 1, y));
    return moved;
}

std::vector<Defect> defects_of(const Scene& scene, const RunReader& run) {
    const Events& events = run.summary().events;
    const double end = run.states().back().time;
    const double time = events.first_break ? events.first_break->time : end;
    Body body(scene, run, time, scene.test.width, scene.test.height);
    const Image right = body.draw(body.picture());
    EXPECT_TRUE(difference(right, body.draw(body.picture())).identical);
    std::vector<Defect> defects;
    const auto add = [&](const char* name, const Image& wrong) {
        defects.push_back({name, difference(right, wrong)});
    };
    const int particle = body.middle_particle();

    Picture2 picture = body.picture();
    picture.x[particle] = 1e9f;
    std::erase_if(picture.intact, [&](int bond) { return body.touches(bond, particle); });
    std::erase_if(picture.broken, [&](int bond) { return body.touches(bond, particle); });
    picture.freshness.resize(picture.broken.size());
    add("missing particle", body.draw(picture));

    // Bonds are hardly drawn at the size of a test, and in the finest scene hardly at that of the film.
    Body large(scene, run, time, scene.view.width, scene.view.height);
    picture = large.picture();
    picture.intact.erase(
        std::ranges::find_if(picture.intact, [&](int bond) { return large.touches(bond, particle); }));
    defects.push_back(
        {"missing bond", difference(large.draw(large.picture()), large.draw(picture)), large.shows_bonds()});

    add("region moved by a pixel", shifted(right));

    picture = body.picture();
    for (float& value : picture.value) value = std::min(1.0f, value + 8 / 255.0f);
    add("colour map shifted by 8 of 256", body.draw(picture));

    if (!body.picture().broken.empty()) {
        picture = body.picture();
        picture.broken.pop_back();
        picture.freshness.pop_back();
        add("break a frame later", body.draw(picture));
    }

    Scene renamed = scene;
    renamed.title.back() = renamed.title.back() == 'x' ? 'o' : 'x';
    renamed.test.frames = {{{}, time}};
    Scene plain = renamed;
    plain.title = scene.title;
    defects.push_back({"one letter of the title", difference(draw_test(plain, run, {}).images[0],
                                                             draw_test(renamed, run, {}).images[0])});
    return defects;
}

/// With the parameters of its test.
void catch_all(const fs::path& file) {
    const TemporaryFolder folder;
    const fs::path run = folder.path() / "run";
    Overrides overrides;
    std::string words;
    for (const std::string& text : read_scene(file).test.params) {
        const std::size_t equals = text.find('=');
        overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
        words += " -p '" + text + "'";
    }
    const Answer answer =
        call(HIBI_PROGRAM " run -q --no-pictures " + file.string() + words + " -o " + run.string());
    ASSERT_EQ(answer.status, 0) << answer.out;
    const Scene scene = read_scene(file, overrides);
    // A body that lacks a bond does not pass, whatever its picture.
    const Reference reference = draw_test(scene, RunReader(run), {}).reference;
    Reference lacking = reference;
    --lacking.bonds;
    EXPECT_EQ(physics_change(reference, reference, {}), "");
    EXPECT_NE(physics_change(reference, lacking, {}), "");
    for (const auto& [name, d, seen] : defects_of(scene, RunReader(run))) {
        if (seen) {
            EXPECT_EQ(judge(d, {}), Sameness::different) << file << ": " << name;
        }
        std::string row = fmt::format("| {} | {} |", file.stem().string(), name);
        for (const Measure& m : measures(d, {})) row += fmt::format(" {:.3g} |", m.value);
        fmt::print("{} {:.5f} |\n", row, d.ssim);
    }
}

std::vector<fs::path> scenes() {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(HIBI_SOURCE_DIR "/scenes"))
        if (entry.path().extension() == ".toml") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

TEST(Defects, AreCaughtInACoarsePlate) { catch_all(HIBI_SOURCE_DIR "/scenes/bending_coarse.toml"); }

class SceneDefects : public testing::TestWithParam<fs::path> {};
TEST_P(SceneDefects, AreCaught) { catch_all(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Slow, SceneDefects, testing::ValuesIn(scenes()),
                         [](const auto& scene) { return scene.param.stem().string(); });

/// What the pictures of `scenes` are on another processor, as far as llvmpipe lets one pretend to have it.
void pass_all(const std::string& scenes, const std::string& environment) {
    const TemporaryFolder folder;
    const Answer answer = call("cd " + folder.path().string() + " && " + environment +
                               " " HIBI_PROGRAM " test -q --json " + scenes + " 2>/dev/null");
    EXPECT_EQ(answer.status, 0) << environment << answer.out;
    for (const Json& scene : Json::parse(answer.out)) {
        EXPECT_FALSE(scene["exact"]) << environment;
        double tile = 0, pixels = 0, mean = 0, rmse = 0, ssim = 1;
        for (const Json& f : scene["frames"]) {
            tile = std::max(tile, f["tile"].get<double>());
            pixels = std::max(pixels, f["pixels"].get<double>());
            for (int c = 0; c < 3; ++c) {
                mean = std::max(mean, std::abs(f["mean"][c].get<double>()));
                rmse = std::max(rmse, f["rmse"][c].get<double>());
            }
            ssim = std::min(ssim, f["ssim"].get<double>());
        }
        fmt::print("| {} | {} | {:.3g} | {:.3g} | {:.3g} | {:.3g} | {:.5f} |\n",
                   fs::path(scene["scene"].get<std::string>()).stem().string(), environment, tile, pixels,
                   mean, rmse, ssim);
    }
}

TEST(Defects, RoundingOfAnotherProcessorIsNone) {
    for (const char* environment : {"GALLIUM_OVERRIDE_CPU_CAPS=nosse", "GALLIUM_OVERRIDE_CPU_CAPS=sse2"})
        pass_all(HIBI_SOURCE_DIR "/scenes/bending_coarse.toml", environment);
}

TEST(SlowDefects, RoundingOfAnotherProcessorIsNoneInAnyScene) {
    for (const char* environment : {"GALLIUM_OVERRIDE_CPU_CAPS=nosse", "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1",
                                    "GALLIUM_OVERRIDE_CPU_CAPS=sse2", "LP_NATIVE_VECTOR_WIDTH=128"})
        pass_all(HIBI_SOURCE_DIR "/scenes " HIBI_SOURCE_DIR "/tests/images", environment);
}

}  // namespace
}  // namespace hibi
