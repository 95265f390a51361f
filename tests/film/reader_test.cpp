#include "film/reader.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "film/encoder.hpp"
#include "image/difference.hpp"
#include "image/png.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;

constexpr int width = 96, height = 64, frames = 7;

/// A bar that wanders over a background that is half gone where the picture is transparent.
Image bar(int number, bool transparent) {
    Image image(width, height);
    image.transparent = transparent;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const bool lit = x / 12 == number;
            const std::array<int, 4> colour = lit           ? std::array{30, 160, 250, 255}
                                              : transparent ? std::array{40, 32, 16, 128}
                                                            : std::array{46, 18, 16, 255};
            for (int c = 0; c < 4; ++c) image.pixel(x, y)[c] = static_cast<std::uint8_t>(colour[c]);
        }
    return image;
}

void write(const fs::path& file, bool transparent) {
    const auto encoder =
        open_encoder(file, {.width = width, .height = height, .fps = 10, .transparent = transparent});
    for (int k = 0; k < frames; ++k) encoder->add(bar(k, transparent));
    encoder->finish();
}

std::vector<FilmFrame> read(const fs::path& file) {
    FilmReader reader(file);
    EXPECT_EQ(reader.bit_depth(), 8);
    std::vector<FilmFrame> list;
    while (std::optional<FilmFrame> frame = reader.next()) list.push_back(std::move(*frame));
    return list;
}

TEST(FilmReader, GivesEveryFrameInItsOrderAtItsTimeInItsColours) {
    const TemporaryFolder folder;
    for (const auto& [format, off] : {std::pair("apng", 0.0), {"gif", 0.0}, {"mp4", 8.0}, {"webm", 8.0}}) {
        SCOPED_TRACE(format);
        const fs::path file = folder.path() / (std::string("movie.") + format);
        write(file, false);
        const std::vector<FilmFrame> seen = read(file);
        ASSERT_EQ(seen.size(), std::size_t(frames));
        for (int k = 0; k < frames; ++k) {
            EXPECT_TRUE(is_opaque(seen[k].image));
            EXPECT_NEAR(seen[k].time, 0.1 * k, 0.011);
            const PixelDifference d = difference(bar(k, false), seen[k].image);
            for (const double mean : d.mean) EXPECT_LE(std::abs(mean), off) << k;
            EXPECT_EQ(d.identical, off == 0) << k;
        }
    }
}

TEST(FilmReader, KeepsWhatIsTransparent) {
    const TemporaryFolder folder;
    for (const auto& [format, off] : {std::pair("apng", 1), {"webm", 10}}) {
        SCOPED_TRACE(format);
        const fs::path file = folder.path() / (std::string("movie.") + format);
        write(file, true);
        const std::vector<FilmFrame> seen = read(file);
        ASSERT_EQ(seen.size(), std::size_t(frames));
        EXPECT_FALSE(is_opaque(seen[2].image));
        const std::array<int, 4> there{40, 32, 16, 128};
        for (int c = 0; c < 4; ++c) EXPECT_NEAR(seen[2].image.pixel(90, 5)[c], there[c], off);
        EXPECT_NEAR(seen[2].image.pixel(29, 5)[3], 255, off);
    }
}

TEST(FilmReader, NamesAFileThatIsDamagedOrNoFilm) {
    const TemporaryFolder folder;
    const auto message = [](const fs::path& file) -> std::string {
        try {
            FilmReader reader(file);
            while (reader.next()) continue;
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    };
    for (const char* format : {"apng", "mp4", "webm"}) {
        const fs::path file = folder.path() / (std::string("movie.") + format);
        write(file, false);
        // A WebM that ends in mid-film cannot be told from a shorter one.
        const std::uintmax_t whole = fs::file_size(file),
                             most = format == std::string("webm") ? 20 : whole - 20;
        for (const std::uintmax_t size : {most, whole / 2, std::uintmax_t{20}, std::uintmax_t{0}}) {
            if (size > most) continue;
            fs::resize_file(file, size);
            EXPECT_EQ(message(file).find(file.string() + ": cannot "), 0u) << size << message(file);
        }
    }
    std::ofstream(folder.path() / "text.gif") << "no film at all";
    EXPECT_NE(message(folder.path() / "text.gif"), "");
    EXPECT_NE(message(folder.path() / "none.gif"), "");
}

}  // namespace
}  // namespace hibi
