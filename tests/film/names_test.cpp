#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "film/encoder.hpp"
#include "film/file.hpp"
#include "film/metadata.hpp"
#include "film/reader.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;

constexpr int width = 64, height = 36, frames = 6;

/// A grey that changes from picture to picture.
Image grey(int number) {
    Image image(width, height);
    std::ranges::fill(image.bgra, static_cast<std::uint8_t>(40 * number));
    return image;
}

int count_frames(const fs::path& file) {
    FilmReader reader(file);
    int count = 0;
    while (reader.next()) ++count;
    return count;
}

/// Names are relative to a folder of the test's own: an absolute path begins with "/", and no protocol does.
class FilmNames : public testing::TestWithParam<std::string> {
 protected:
    void SetUp() override {
        before_ = fs::current_path();
        fs::current_path(folder_.path());
    }
    void TearDown() override { fs::current_path(before_); }

    TemporaryFolder folder_;
    fs::path before_;
};

TEST_P(FilmNames, AFilmIsWrittenAndReadUnderEveryName) {
    for (const std::string& format : film_formats())
        for (const fs::path& file :
             {fs::path(GetParam()) / ("movie." + format), fs::path(GetParam() + "." + format)}) {
            SCOPED_TRACE(file);
            if (file.has_parent_path()) fs::create_directories(file.parent_path());
            const auto encoder = open_encoder(
                file, {.width = width, .height = height, .fps = 10, .metadata = {{"comment", "told"}}});
            for (int k = 0; k < frames; ++k) encoder->add(grey(k));
            encoder->finish();
            // Under this name, and nothing else beside it.
            ASSERT_TRUE(fs::is_regular_file(file));
            const fs::path parent = file.has_parent_path() ? file.parent_path() : fs::path(".");
            int files = 0;
            for (const auto& entry : fs::directory_iterator(parent)) files += entry.is_regular_file();
            EXPECT_EQ(files, 1);
            // FFmpeg decodes no animated WebP, and knows no comment of an APNG.
            if (format != "webp") {
                EXPECT_EQ(count_frames(file), frames);
            }
            if (format != "webp" && format != "apng") {
                bool told = false;
                for (const auto& [key, text] : film_metadata(file)) told |= text == "told";
                EXPECT_TRUE(told);
            }
            fs::remove(file);
        }
}

INSTANTIATE_TEST_SUITE_P(Of, FilmNames,
                         testing::Values("12:30", "a:b", "file:x", "http:x", "http:", "pipe:1", "concat:a|b",
                                         "data:x", "%d", "m%03d", "100%", "two words", "it's \"so\"", "-lead",
                                         "-", "ひび 割れ", "back\\slash", "x?y#z&w", "*[a-z]", "line\nend",
                                         ".hidden"),
                         [](const auto& name) { return std::to_string(name.index); });

}  // namespace
}  // namespace hibi
