#include "image/image.hpp"

#include <gtest/gtest.h>

namespace hibi {
namespace {

Image two_pixels() {
    Image image(2, 1);
    image.bgra = {3, 2, 1, 77, 0xff, 0xfe, 0xfd, 88};  // R G B = 1 2 3 and fd fe ff
    return image;
}

TEST(PixelHash, IsThatOfSizeAndRgbBytes) {
    // printf '2x1\n\x01\x02\x03\xfd\xfe\xff' | sha256sum
    EXPECT_EQ(pixel_hash(two_pixels()), "1050ba5084f4d2401b7460de0e4c169c89d94d7576138e06facf56a4a03b15c9");
}

TEST(PixelHash, IgnoresTheFourthByteButNoColourAndNoSize) {
    Image image = two_pixels();
    image.bgra[3] = 0;
    EXPECT_EQ(pixel_hash(image), pixel_hash(two_pixels()));
    for (const int byte : {0, 1, 2, 4, 5, 6}) {
        Image other = two_pixels();
        other.bgra[byte] ^= 1;
        EXPECT_NE(pixel_hash(other), pixel_hash(two_pixels())) << byte;
    }
    Image tall = two_pixels();
    std::swap(tall.width, tall.height);
    EXPECT_NE(pixel_hash(tall), pixel_hash(two_pixels()));
}

/// One colour and alpha (0..1) as it looks over a colour, as a renderer would draw it.
Image over(const Rgb& colour, double alpha, const Rgb& below) {
    Image image(1, 1);
    for (int c = 0; c < 3; ++c)
        image.bgra[2 - c] =
            static_cast<std::uint8_t>(255 * (alpha * colour[c] + (1 - alpha) * below[c]) + 0.5);
    return image;
}

TEST(Transparency, AlphaIsWhatBlackAndWhiteTell) {
    for (const Rgb& colour : {Rgb{1, 0.5f, 0}, Rgb{0, 0, 0}, Rgb{1, 1, 1}, Rgb{0.1f, 0.7f, 0.3f}})
        for (const double alpha : {0.0, 0.01, 0.3, 0.5, 0.99, 1.0}) {
            Image image = over(colour, alpha, {0, 0, 0});
            find_alpha(image, over(colour, alpha, {1, 1, 1}));
            EXPECT_TRUE(image.transparent);
            EXPECT_NEAR(image.bgra[3], 255 * alpha, 1);
            const Image on_red = laid_on(image, {1, 0, 0});
            EXPECT_FALSE(on_red.transparent);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(on_red.bgra[c], over(colour, alpha, {1, 0, 0}).bgra[c], 1.5);
        }
}

TEST(Transparency, StraightColoursComeBackExactly) {
    for (int alpha = 0; alpha <= 255; alpha += 5)
        for (int colour = 0; colour <= alpha; ++colour) {
            Image image(1, 1);
            image.transparent = true;
            for (int c = 0; c < 3; ++c) image.bgra[c] = static_cast<std::uint8_t>(colour);
            image.bgra[3] = static_cast<std::uint8_t>(alpha);
            std::array<std::uint8_t, 4> straight{};
            to_straight(image, straight.data(), {1, 1, 1});
            if (alpha == 0) {
                EXPECT_EQ(straight[0], 255);
            }
            if (alpha == 0) continue;
            EXPECT_NEAR(straight[0], 255.0 * colour / alpha, 0.5);
            to_premultiplied(straight.data(), 1);
            EXPECT_EQ(straight[0], colour) << alpha;
        }
}

TEST(Transparency, ItsHashIsThatOfFourBytesPerPixelWhereAnythingShowsThrough) {
    Image image = two_pixels();
    const std::string of_colours = pixel_hash(image);
    image.transparent = true;
    image.bgra[3] = 255;
    image.bgra[7] = 255;
    EXPECT_EQ(pixel_hash(image), of_colours);  // an alpha that hides nothing does not count
    for (int k = 4; k < 8; ++k) image.bgra[k] = 0;
    // printf '2x1\n\x01\x02\x03\xff\x00\x00\x00\x00' | sha256sum
    EXPECT_EQ(pixel_hash(image), "78327001a4e0acc5f9c20907969280a37086891be1ce722bfc58fa2bd1479e85");
}

}  // namespace
}  // namespace hibi
