#include "render/renderer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pictures.hpp"

namespace hibi {
namespace {

using pictures::at;
using pictures::bytes;
using pictures::entry;
using pictures::Stage;

// Discs are this much smaller than the particle spacing (shaders/particle.vert).
constexpr double disc_share = 0.97;

TEST(Renderer, DiscHasItsAreaAndCentre) {
    Stage stage(120, 90, "print");
    ASSERT_EQ(theme("print").rim, 0);  // one colour per disc: coverage can be read from the pixels
    stage.particle(60.25, 90 - 40.5, 50);
    const Image image = stage.draw();
    const double paper = bytes(theme("print").background)[1], ink = entry("inferno", 128)[1];
    double area = 0, x_moment = 0, y_moment = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double cover = (paper - at(image, x, y)[1]) / (paper - ink);
            area += cover;
            x_moment += cover * (x + 0.5);
            y_moment += cover * (y + 0.5);
        }
    const double radius = disc_share * 25;
    EXPECT_NEAR(area, std::numbers::pi * radius * radius, 0.01 * area);
    EXPECT_NEAR(x_moment / area, 60.25, 0.02);
    EXPECT_NEAR(y_moment / area, 40.5, 0.02);
}

TEST(Renderer, DiscIsSymmetric) {
    Stage stage(64, 64, "dark");
    stage.particle(32, 32, 40);
    const Image image = stage.draw();
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) {
            EXPECT_EQ(at(image, x, y), at(image, 63 - x, y));
            EXPECT_EQ(at(image, x, y), at(image, x, 63 - y));
            EXPECT_EQ(at(image, x, y), at(image, y, x));
        }
}

TEST(Renderer, ColourIsTheEntryOfTheMap) {
    Stage stage(300, 60, "dark");
    stage.view.map = "viridis";
    stage.particle(30, 30, 40, 0.0f);
    stage.particle(90, 30, 40, 100 / 255.0f);
    stage.particle(150, 30, 40, 1.0f);
    stage.particle(210, 30, 40, -3.0f);
    stage.particle(270, 30, 40, 7.0f);
    const Image image = stage.draw();
    EXPECT_EQ(at(image, 30, 30), entry("viridis", 0));
    EXPECT_EQ(at(image, 90, 30), entry("viridis", 100));
    EXPECT_EQ(at(image, 150, 30), entry("viridis", 255));
    EXPECT_EQ(at(image, 210, 30), entry("viridis", 0));
    EXPECT_EQ(at(image, 270, 30), entry("viridis", 255));
    EXPECT_EQ(at(image, 60, 2), bytes(theme("dark").background));
}

TEST(Renderer, WorldUpIsPictureUp) {
    Stage stage(60, 100, "dark");
    stage.particle(30, 80, 30);
    const Image image = stage.draw();
    EXPECT_EQ(at(image, 30, 20), entry("inferno", 128));
    EXPECT_EQ(at(image, 30, 80), bytes(theme("dark").background));
}

TEST(Renderer, RimIsDarkerThanTheDisc) {
    Stage stage(64, 64, "dark");
    stage.particle(32, 32, 40);
    const Image image = stage.draw();
    EXPECT_LT(at(image, 32 + 18, 32)[0], 0.85 * at(image, 32, 32)[0]);  // theme.rim is 0.35 at the very edge
    EXPECT_EQ(at(image, 32 + 14, 32), at(image, 32, 32));
}

TEST(Renderer, DenseBodyHasNoGaps) {
    Stage stage(100, 100, "dark");
    const double spacing = 2.37;
    for (int j = 0; j < 30; ++j)
        for (int i = 0; i < 30; ++i) stage.particle(10 + spacing * i, 10 + spacing * j, spacing, 0.9f);
    const Image image = stage.draw();
    for (int y = 30; y < 80; ++y)
        for (int x = 15; x < 70; ++x) EXPECT_GT(at(image, x, y)[0], 0.9 * entry("inferno", 230)[0]);
}

TEST(Renderer, ParticleWhoseCentreLeftThePictureIsStillDrawn) {
    for (const double spacing : {60.0, 240.0, 600.0}) {  // sprites, the largest sprites, squares
        Stage stage(100, 100, "dark");
        stage.particle(-0.4 * spacing, 50, spacing);
        const Image image = stage.draw();
        EXPECT_EQ(at(image, 1, 50), entry("inferno", 128)) << spacing;
    }
}

TEST(Renderer, NothingIsDrawnOutsideTheCamerasRectangle) {
    Stage stage(200, 100, "dark");
    stage.picture.camera.rect = {50, 20, 100, 60};
    stage.picture.camera.centre_x = 100;
    stage.picture.camera.centre_y = 50;
    stage.particle(100, 50, 180);
    const Image image = stage.draw();
    const auto background = bytes(theme("dark").background);
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 200; ++x)
            EXPECT_EQ(at(image, x, y) == background, x < 50 || x >= 150 || y < 20 || y >= 80)
                << x << ' ' << y;
}

TEST(Renderer, SquaresAboveTheSpriteLimitGiveTheSpritesPixels) {
    Stage sprites(300, 260, "dark");
    sprites.particle(150.3, 129.6, 247.5);
    Stage squares = sprites;
    squares.particle(-5000, 0, 300);  // out of sight, but too large for a sprite
    EXPECT_EQ(sprites.draw().bgra, squares.draw().bgra);
    Stage larger(300, 260, "dark");
    larger.particle(150, 130, 255);
    const Image image = larger.draw();  // would be cut to 255 pixels as a sprite, margin included
    const int edge = static_cast<int>(disc_share * 255 / 2);
    EXPECT_NE(at(image, 150 - edge, 130), bytes(theme("dark").background));
    EXPECT_EQ(at(image, 150 - edge - 3, 130), bytes(theme("dark").background));
}

TEST(Renderer, IntactBondFillsTheBodyAndIsALine) {
    Stage loose(100, 60, "dark");
    const int a = loose.particle(30, 30, 40), b = loose.particle(70, 30, 40);
    Stage bonded = loose;
    bonded.intact_bond(a, b);
    const Image without = loose.draw(), with = bonded.draw();
    const auto background = bytes(theme("dark").background);
    EXPECT_EQ(at(without, 50, 14), background);  // the gap above where the discs touch
    EXPECT_NE(at(with, 50, 14), background);
    EXPECT_NE(at(with, 40, 29), at(without, 40, 29));  // the line over the disc
    EXPECT_EQ(at(with, 40, 40), at(without, 40, 40));
    EXPECT_EQ(at(with, 30, 5), background);
}

TEST(Renderer, CrackLiesAcrossTheBondAtItsMiddle) {
    const int middle = 540;
    for (const bool fresh : {false, true}) {
        Stage sound(120, 1080, "dark");
        const int a = sound.particle(35, 540, 50), b = sound.particle(85, 540, 50);
        Stage cracked = sound;
        cracked.broken_bond(a, b, fresh ? 1.0f : 0.0f);
        const Image before = sound.draw(), after = cracked.draw();
        const auto mark = bytes(fresh ? theme("dark").crack_fresh : theme("dark").crack_old);
        for (const int off : {-20, -10, 0, 10, 19}) {
            EXPECT_EQ(at(after, 60, middle + off)[0], mark[0]) << off;
            EXPECT_EQ(at(after, 60, middle + off)[1], mark[1]) << off;
        }
        for (const int off : {-20, -10, 10, 20})
            EXPECT_EQ(at(after, 60 + off, middle), at(before, 60 + off, middle));
        EXPECT_EQ(at(after, 60, middle + 28), at(before, 60, middle + 28));  // no longer than the spacing
    }
}

TEST(Renderer, FreshCrackLiesAboveAnOldOne) {
    Stage stage(120, 1080, "dark");
    const int a = stage.particle(35, 540, 50), b = stage.particle(85, 540, 50);
    stage.broken_bond(a, b, 1.0f);
    stage.broken_bond(a, b, 0.0f);
    EXPECT_EQ(at(stage.draw(), 60, 540), bytes(theme("dark").crack_fresh));
}

TEST(Renderer, NoMarkFloatsBetweenFacesThatHaveParted) {
    Stage stage(300, 100, "dark");
    const int a = stage.particle(50, 50, 50), b = stage.particle(100, 50, 50);
    stage.broken_bond(a, b, 1.0f);
    stage.picture.x[b] = 50 + 3 * 50;
    EXPECT_EQ(at(stage.draw(), 125, 50), bytes(theme("dark").background));
}

// The same body in a picture six times as large: marks cover 36 times the pixels.
TEST(Renderer, MarksGrowWithThePicture) {
    const auto changed_pixels = [](int factor) {
        Stage sound(320 * factor, 180 * factor, "dark");
        const int a = sound.particle(150 * factor, 90 * factor, 12 * factor);
        const int b = sound.particle(162 * factor, 90 * factor, 12 * factor);
        Stage cracked = sound;
        cracked.broken_bond(a, b, 0.0f);
        const Image before = sound.draw(), after = cracked.draw();
        double sum = 0;
        for (std::size_t i = 1; i < before.bgra.size(); i += 4)
            sum += std::abs(before.bgra[i] - after.bgra[i]);
        return sum;
    };
    const double small = changed_pixels(1), large = changed_pixels(6);
    ASSERT_GT(small, 0);
    // A mark is never thinner than a pixel: hence not exactly 36.
    EXPECT_GT(large / small, 20);
    EXPECT_LT(large / small, 50);
}

TEST(Renderer, WhatAnEarlierPictureShowedDoesNotShow) {
    const Stage stage = pictures::cracked_plate();
    Picture2 fewer = stage.picture;
    fewer.intact.erase(fewer.intact.begin(), fewer.intact.begin() + 20);
    fewer.broken.pop_back();
    fewer.freshness.pop_back();
    Renderer used(stage.view, stage.body);
    for (const Picture2& picture : {stage.picture, fewer, fewer, stage.picture}) {
        Image expected, actual;
        Renderer(stage.view, stage.body).draw(picture, expected);
        used.draw(picture, actual);
        EXPECT_TRUE(actual.bgra == expected.bgra);
    }
}

TEST(Renderer, BondsShowWhereTheirParticlesLieApart) {
    Stage stage(120, 90, "dark");
    stage.particle(30, 40, 20);
    const Renderer renderer(stage.view, stage.body);
    Camera2 camera = stage.picture.camera;
    EXPECT_TRUE(renderer.shows_bonds(camera));
    camera.scale = 0.1;  // 2 pixels apart
    EXPECT_FALSE(renderer.shows_bonds(camera));
}

}  // namespace
}  // namespace hibi
