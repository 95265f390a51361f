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

}  // namespace
}  // namespace hibi
