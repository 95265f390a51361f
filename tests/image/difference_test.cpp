#include "image/difference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <random>

#include "image/theme.hpp"

namespace hibi {
namespace {

Image plain(int width, int height, int grey) {
    Image image(width, height);
    std::ranges::fill(image.bgra, static_cast<std::uint8_t>(grey));
    return image;
}

void add(Image& image, int x, int y, int blue, int green, int red) {
    std::uint8_t* p = image.pixel(x, y);
    p[0] = static_cast<std::uint8_t>(p[0] + blue);
    p[1] = static_cast<std::uint8_t>(p[1] + green);
    p[2] = static_cast<std::uint8_t>(p[2] + red);
}

TEST(Difference, OfEqualPicturesIsNothing) {
    const Image image = plain(50, 40, 90);
    const PixelDifference d = difference(image, image);
    EXPECT_TRUE(d.identical);
    EXPECT_EQ(judge(d, {}), Sameness::identical);
    EXPECT_EQ(judge(d, {.tile = 0, .pixels = 0, .mean = 0, .rmse = 0}), Sameness::identical);
}

TEST(Difference, MeasuresWhatWasPutIn) {
    const Image a = plain(100, 100, 90);
    Image b = a;
    for (int x = 40; x < 50; ++x) add(b, x, 60, 0, 0, 20);  // ten pixels, red up by 20
    for (int x = 40; x < 50; ++x) add(b, x, 61, 0, -10, 0);
    const PixelDifference d = difference(a, b);
    EXPECT_EQ(d.largest, 20);
    EXPECT_EQ(d.far_pixels, 10);
    EXPECT_DOUBLE_EQ(d.pixels, 1000);   // 10 of 10 000
    EXPECT_DOUBLE_EQ(d.mean[0], 0.02);  // 200 / 10 000
    EXPECT_DOUBLE_EQ(d.mean[1], -0.01);
    EXPECT_DOUBLE_EQ(d.rmse[0], std::sqrt(0.4));  // 10 * 400 / 10 000
    EXPECT_DOUBLE_EQ(d.rmse[2], 0);
    // Luma 54/256 of red, 183/256 of green; all of it lies in one tile of 1024 pixels.
    const double red = 20 * 54 / 256.0, green = 10 * 183 / 256.0;
    EXPECT_NEAR(d.tile, std::sqrt(10 * (red * red + green * green) / 1024), 1e-12);
    EXPECT_LE(d.tile_at[0], 40);
    EXPECT_GE(d.tile_at[0] + 32, 50);
    EXPECT_LE(d.tile_at[1], 60);
    EXPECT_GE(d.tile_at[1] + 32, 62);
    EXPECT_EQ(judge(d, {}), Sameness::different);
}

TEST(Difference, FindsAPixelInEveryCornerOfAnySize) {
    for (const auto& [w, h] : {std::pair(320, 180), std::pair(33, 47), std::pair(31, 5), std::pair(1, 1)})
        for (const int x : {0, w - 1})
            for (const int y : {0, h - 1}) {
                const Image a = plain(w, h, 0);
                Image b = a;
                add(b, x, y, 100, 100, 100);
                const PixelDifference d = difference(a, b);
                EXPECT_NEAR(d.tile, std::sqrt(1e4 / (std::min(w, 32) * std::min(h, 32))), 1e-9)
                    << w << " x " << h << " at " << x << ", " << y;
                EXPECT_TRUE(d.tile_at[0] <= x && x < d.tile_at[0] + 32);
                EXPECT_TRUE(d.tile_at[1] <= y && y < d.tile_at[1] + 32);
            }
}

// A defect on the border of four tiles would count a quarter in each, did they not overlap.
TEST(Difference, TilesOverlapByHalf) {
    const Image a = plain(320, 180, 100);
    Image b = a;
    for (int y = 48; y < 80; ++y)
        for (int x = 80; x < 112; ++x) add(b, x, y, 4, 4, 4);
    const PixelDifference d = difference(a, b);
    EXPECT_NEAR(d.tile, 4, 1e-12);
    EXPECT_EQ(d.tile_at, (std::array{80, 48}));
}

TEST(Difference, APixelIsFarOffBySeventeenInAnyChannel) {
    const Image a = plain(320, 180, 100);
    for (int c = 0; c < 3; ++c) {
        Image b = a;
        b.pixel(7, 9)[c] = 116;
        EXPECT_EQ(difference(a, b).far_pixels, 0);
        b.pixel(7, 9)[c] = 117;
        const PixelDifference d = difference(a, b);
        EXPECT_EQ(d.far_pixels, 1);
        EXPECT_EQ(d.largest, 17);
        EXPECT_EQ(judge(d, {}), Sameness::tolerated);
        EXPECT_EQ(judge(d, {.pixels = 0}), Sameness::different);  // who asks for none gets none
    }
}

TEST(Difference, WhatReachesALimitHoldsAndDarkerCountsAsBrighter) {
    const Image a = plain(320, 180, 100), darker = plain(320, 180, 98);
    const PixelDifference d = difference(a, darker);
    EXPECT_DOUBLE_EQ(d.mean[1], -2);
    const Tolerance reached{.tile = 2, .pixels = 0, .mean = 2, .rmse = 2};
    EXPECT_EQ(judge(d, reached), Sameness::tolerated);
    Tolerance less = reached;
    less.tile = 1.99;
    EXPECT_EQ(judge(d, less), Sameness::different);
    less = reached, less.mean = 1.99;
    EXPECT_EQ(judge(d, less), Sameness::different);
    less = reached, less.rmse = 1.99;
    EXPECT_EQ(judge(d, less), Sameness::different);
}

TEST(Difference, EachLimitDecidesByItself) {
    const Image a = plain(320, 180, 100);
    Image tile = a;  // 32 x 32 pixels brighter by 4
    for (int y = 64; y < 96; ++y)
        for (int x = 64; x < 96; ++x) add(tile, x, y, 4, 4, 4);
    Image far = a;  // two pixels: at this size one is allowed
    add(far, 10, 10, 0, 0, 17);
    EXPECT_EQ(judge(difference(a, far), {}), Sameness::tolerated);
    add(far, 200, 100, 0, 0, 17);
    Image mean = plain(320, 180, 101);
    Image rmse = a;  // a hundred pixels in a thousand by 8, up and down
    for (int k = 0; k < 320 * 180; ++k)
        if (k % 10 == 0) add(rmse, k % 320, k / 320, k % 20 ? 8 : -8, 0, 0);
    const char* names[] = {"worst tile", "pixels far off per megapixel", "mean difference", "RMS difference"};
    int at = 0;
    for (const Image* b : {&tile, &far, &mean, &rmse}) {
        const PixelDifference d = difference(a, *b);
        EXPECT_EQ(judge(d, {}), Sameness::different);
        for (const Measure& m : measures(d, {})) EXPECT_EQ(m.holds, m.name != names[at]) << m.name << m.value;
        ++at;
    }
}

TEST(Difference, OfTransparentPicturesIsTheWorseOverBlackAndWhite) {
    Image a = plain(64, 64, 0);  // nothing at all
    a.transparent = true;
    Image b = a;
    for (int x = 0; x < 20; ++x) b.pixel(x, 5)[3] = 255;  // a black stroke, not to be seen over black
    const PixelDifference d = difference(a, b);
    EXPECT_EQ(d.far_pixels, 20);
    EXPECT_EQ(d.largest, 255);
    EXPECT_NEAR(d.tile, 255 * std::sqrt(20 / 1024.0), 1e-9);
    for (int c = 0; c < 3; ++c) {
        EXPECT_DOUBLE_EQ(d.mean[c], -255 * 20 / 4096.0);
        EXPECT_DOUBLE_EQ(d.rmse[c], 255 * std::sqrt(20 / 4096.0));
    }
    EXPECT_LT(d.ssim, 1);
    EXPECT_EQ(judge(d, {}), Sameness::different);
    EXPECT_GT(heat_map(a, b, d).pixel(3, 5)[2], 200);
}

TEST(Difference, OfOtherSizesIsRefused) {
    EXPECT_THROW(difference(plain(10, 10, 0), plain(10, 11, 0)), std::invalid_argument);
}

TEST(Difference, AnAlphaThatHidesNothingChangesNothing) {
    const Image plainly = plain(64, 64, 90);  // its fourth byte is not alpha, and says nothing
    Image with_alpha = plainly;
    with_alpha.transparent = true;
    for (std::size_t alpha = 3; alpha < with_alpha.bgra.size(); alpha += 4) with_alpha.bgra[alpha] = 255;
    for (const PixelDifference& d : {difference(plainly, with_alpha), difference(with_alpha, plainly)})
        EXPECT_EQ(judge(d, {}), Sameness::identical);
    EXPECT_EQ(pixel_hash(plainly), pixel_hash(with_alpha));
    EXPECT_EQ(pixel_hash(heat_map(plainly, with_alpha, {})), pixel_hash(heat_map(plainly, plainly, {})));
    add(with_alpha, 5, 5, 0, 0, 40);
    EXPECT_EQ(difference(plainly, with_alpha).largest, 40);
    EXPECT_EQ(difference(plainly, with_alpha).far_pixels, 1);
}

TEST(Difference, OfATransparentAndAnOpaquePictureIsWhatShowsThrough) {
    const Image opaque = plain(64, 64, 0);  // black
    Image hole = opaque;
    hole.transparent = true;
    for (std::size_t alpha = 3; alpha < hole.bgra.size(); alpha += 4) hole.bgra[alpha] = 255;
    for (int x = 0; x < 20; ++x) hole.pixel(x, 5)[3] = 55;  // black over black, and nearly white over white
    for (const PixelDifference& d : {difference(opaque, hole), difference(hole, opaque)}) {
        EXPECT_EQ(d.largest, 200);
        EXPECT_EQ(d.far_pixels, 20);
        EXPECT_EQ(judge(d, {}), Sameness::different);
    }
    EXPECT_GT(heat_map(opaque, hole, difference(opaque, hole)).pixel(3, 5)[2], 200);
    EXPECT_GT(heat_map(hole, opaque, difference(hole, opaque)).pixel(3, 5)[2], 200);
    EXPECT_NE(pixel_hash(opaque), pixel_hash(hole));
}

TEST(Difference, SimilarityIsOneMinusALittleForNoise) {
    std::mt19937 random(3);
    Image a = plain(64, 64, 100), b = a;
    for (std::size_t k = 0; k < a.bgra.size(); ++k)
        a.bgra[k] = static_cast<std::uint8_t>(100 + random() % 50), b.bgra[k] = a.bgra[k];
    EXPECT_EQ(difference(a, b).ssim, 1);
    for (std::size_t k = 0; k < a.bgra.size(); ++k)
        b.bgra[k] = static_cast<std::uint8_t>(b.bgra[k] + random() % 3);
    EXPECT_GT(difference(a, b).ssim, 0.95);
    EXPECT_LT(difference(a, plain(64, 64, 125)).ssim, 0.5);  // no structure left
}

// Without structure only the means are compared: (2 a b + c1) / (a^2 + b^2 + c1), c1 = (0.01 * 255)^2.
TEST(Difference, SimilarityOfEvenGreysIsThatOfTheirMeans) {
    const Image a = plain(64, 64, 100);
    const double c1 = 2.55 * 2.55, even = (2 * 100 * 110 + c1) / (100 * 100 + 110 * 110 + c1);
    EXPECT_NEAR(difference(a, plain(64, 64, 110)).ssim, even, 1e-9);
    Image b = a;  // one of eight rows of blocks
    for (int k = 0; k < 8 * 64; ++k) add(b, k % 64, k / 64, 10, 10, 10);
    EXPECT_NEAR(difference(a, b).ssim, (7 + even) / 8, 1e-9);
}

TEST(Difference, HeatMapIsBrightWhereItDiffersAndFramesTheTile) {
    const Image a = plain(100, 100, 100);
    Image b = a;
    add(b, 50, 50, 64, 64, 64);
    add(b, 52, 50, 0, 16, 0);
    const PixelDifference d = difference(a, b);
    const Image heat = heat_map(a, b, d);
    EXPECT_EQ(heat.pixel(5, 5)[0], 20);  // grey, a fifth
    const ColourMap& map = colour_map("inferno");
    for (int c = 0; c < 3; ++c) {
        EXPECT_EQ(heat.pixel(50, 50)[c], map[255][2 - c]);  // 64 is the bright end
        EXPECT_EQ(heat.pixel(52, 50)[c], map[127][2 - c]);  // a quarter of it, by the root
    }
    const int x0 = d.tile_at[0] - 1, y0 = d.tile_at[1] - 1, x1 = x0 + 33, y1 = y0 + 33;
    for (int k = 0; k <= 33; ++k)
        for (const auto& [x, y] : {std::pair(x0 + k, y0), {x0 + k, y1}, {x0, y0 + k}, {x1, y0 + k}})
            EXPECT_EQ(heat.pixel(x, y)[1], 255) << x << ", " << y;
    EXPECT_EQ(heat.pixel(x0 + 1, y0 + 1)[1], 20);  // nothing of the tile is hidden
}

// A film has hundreds of frames: a pair of 1920 x 1080 takes 18 ms of a Zen 3 core, and must stay below 100.
// Five times that here, since tests run beside others.
TEST(Difference, IsFast) {
    const Image a = plain(1920, 1080, 100);
    Image b = a;
    for (int k = 0; k < 1920 * 1080; k += 7) add(b, k % 1920, k / 1920, 1, 0, 1);
    const auto begin = std::clock();
    EXPECT_FALSE(difference(a, b).identical);
    EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, 0.5);
}

}  // namespace
}  // namespace hibi
