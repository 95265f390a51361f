#include "image/png.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <fstream>
#include <stdexcept>

#include "image/difference.hpp"
#include "support/temporary_folder.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;

/// Every pixel another colour, neither side a power of two.
Image gradient() {
    Image image(61, 37);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            std::uint8_t* p = image.pixel(x, y);
            p[0] = static_cast<std::uint8_t>(4 * x);
            p[1] = static_cast<std::uint8_t>(6 * y);
            p[2] = static_cast<std::uint8_t>(x * y);
        }
    return image;
}

std::string message_of_reading(const fs::path& file) {
    try {
        read_png(file);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

void write_bytes(const fs::path& file, const std::vector<unsigned char>& bytes) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
}

TEST(Png, PixelsAndTextComeBack) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "a.png";
    for (const bool small : {false, true}) {
        write_png(file, gradient(),
                  {.text = {{"Title", "Bending"}, {"Comment", "曲げ破壊, ν = 0.3"}}, .small = small});
        PngText text;
        EXPECT_EQ(pixel_hash(read_png(file, &text)), pixel_hash(gradient()));
        EXPECT_EQ(text["Title"], "Bending");
        EXPECT_EQ(text["Comment"], "曲げ破壊, ν = 0.3");
    }
    EXPECT_FALSE(fs::exists(file.string() + ".tmp"));
}

TEST(Png, TransparentPixelsComeBack) {
    Image image(64, 64);
    image.transparent = true;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            std::uint8_t* p = image.pixel(x, y);
            p[3] = static_cast<std::uint8_t>(4 * x);
            for (int c = 0; c < 3; ++c) p[c] = static_cast<std::uint8_t>(p[3] * (y + c) / 66);
        }
    const TemporaryFolder folder;
    write_png(folder.path() / "a.png", image);
    const Image back = read_png(folder.path() / "a.png");
    EXPECT_TRUE(back.transparent);
    EXPECT_EQ(back.bgra, image.bgra);
    EXPECT_EQ(pixel_hash(back), pixel_hash(image));
}

/// How a PNG may hold the same greys.
struct Kind {
    int colours;  ///< PNG_COLOR_TYPE_...
    bool interlaced = false;
    bool unused_transparent = false;  ///< a tRNS chunk that makes a colour transparent which does not occur
};

/// Greys of even steps; 255 and the colour (255, 0, 0) do not occur.
void write_greys(const fs::path& file, const Kind& kind, bool with_hole = false) {
    constexpr int side = 16;
    std::FILE* out = std::fopen(file.c_str(), "wb");
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, out);
    png_set_IHDR(png, info, side, side, 8, kind.colours,
                 kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    std::vector<png_color> palette;
    for (int grey = 0; grey < 256; ++grey)
        palette.push_back({png_byte(grey), png_byte(grey), png_byte(grey)});
    std::vector<png_byte> alphas(256, 255);
    alphas[255] = 0;
    png_color_16 unused{.index = 0, .red = 255, .green = 0, .blue = 0, .gray = 255};
    if (kind.colours == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), 256);
    if (kind.unused_transparent) png_set_tRNS(png, info, alphas.data(), 256, &unused);
    png_write_info(png, info);
    const int channels = png_get_channels(png, info);
    const bool has_alpha = kind.colours & PNG_COLOR_MASK_ALPHA;
    std::vector<png_byte> pixels;
    for (int k = 0; k < side * side; ++k)
        for (int c = 0; c < channels; ++c)
            pixels.push_back(
                png_byte(has_alpha && c == channels - 1 ? (with_hole && k == 200 ? 0 : 255) : k / 2));
    std::vector<png_bytep> rows;
    for (int y = 0; y < side; ++y) rows.push_back(pixels.data() + y * side * channels);
    png_write_image(png, rows.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    std::fclose(out);
}

TEST(Png, ThePictureIsTheSameInWhateverWayItIsStored) {
    const TemporaryFolder folder;
    const fs::path plain = folder.path() / "plain.png", other = folder.path() / "other.png";
    write_greys(plain, {PNG_COLOR_TYPE_RGB});
    for (const int colours : {PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGBA, PNG_COLOR_TYPE_GRAY,
                              PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_PALETTE})
        for (const bool interlaced : {false, true})
            for (const bool transparent : {false, true}) {
                if (transparent && colours & PNG_COLOR_MASK_ALPHA) continue;
                SCOPED_TRACE(testing::Message() << colours << interlaced << transparent);
                write_greys(other, {colours, interlaced, transparent});
                EXPECT_TRUE(difference(read_png(plain), read_png(other)).identical);
                EXPECT_EQ(pixel_hash(read_png(plain)), pixel_hash(read_png(other)));
            }
    for (const int colours : {PNG_COLOR_TYPE_RGBA, PNG_COLOR_TYPE_GRAY_ALPHA}) {
        write_greys(other, {colours}, true);
        EXPECT_FALSE(difference(read_png(plain), read_png(other)).identical);
    }
}

TEST(Png, SmallSettingIsSmaller) {
    EXPECT_LT(encode_png(gradient(), {.small = true}).size(), encode_png(gradient()).size());
}

TEST(Png, EveryTruncationIsAnErrorNamingTheFile) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "cut.png";
    const std::vector<unsigned char> whole = encode_png(gradient());
    for (std::size_t size = 0; size < whole.size(); size += 97) {
        write_bytes(file, {whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)});
        EXPECT_NE(message_of_reading(file).find("cut.png"), std::string::npos) << size;
        if (size > whole.size() / 2) {
            EXPECT_NE(message_of_reading(file).find("ends too early"), std::string::npos) << size;
        }
    }
}

TEST(Png, DamageIsSaidAndOtherFilesAreNoPictures) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "b.png";
    std::vector<unsigned char> bytes = encode_png(gradient());
    bytes[bytes.size() / 2] ^= 0x55;
    write_bytes(file, bytes);
    EXPECT_NE(message_of_reading(file).find("damaged PNG"), std::string::npos);
    write_bytes(file, {'v', 'e', 'r', 's', 'i', 'o', 'n', ' ', '=', ' ', '1'});
    EXPECT_NE(message_of_reading(file).find("not a PNG"), std::string::npos);
    EXPECT_NE(message_of_reading(folder.path() / "none.png").find("none.png: cannot open"),
              std::string::npos);
}

TEST(Png, AFileThatCannotBeWrittenIsNamed) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "no such folder" / "a.png";
    try {
        write_png(file, gradient());
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos);
    }
}

TEST(Png, SaysHowLargeItIsInPrint) {
    const std::vector<unsigned char> bytes = encode_png(gradient(), {.dpi = 300});
    const std::string text(bytes.begin(), bytes.end());
    const std::size_t at = text.find("pHYs");
    ASSERT_NE(at, std::string::npos);
    // 300 per inch are 11811 (0x2e23) per metre, along both axes; the unit is 1.
    EXPECT_EQ(text.substr(at + 4, 9), std::string("\0\0\x2e\x23\0\0\x2e\x23\1", 9));
    const std::vector<unsigned char> plain = encode_png(gradient());
    EXPECT_EQ(std::string(plain.begin(), plain.end()).find("pHYs"), std::string::npos);
}

}  // namespace
}  // namespace hibi
