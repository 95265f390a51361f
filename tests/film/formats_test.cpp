#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <map>

#include "film/encoder.hpp"
#include "film/metadata.hpp"
#include "image/png.hpp"
#include "support/temporary_folder.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

namespace hibi {
namespace {

namespace fs = std::filesystem;

struct Watched {
    int width = 0, height = 0;
    std::vector<double> times;
    std::vector<std::vector<std::uint8_t>> pictures;  ///< B, G, R, alpha, not multiplied by it
};

/// Decodes a film with the libraries, alpha included. FFmpeg's own VP9 decoder knows no alpha.
Watched watch(const fs::path& file) {
    Watched film;
    AVFormatContext* input = nullptr;
    if (avformat_open_input(&input, file.c_str(), nullptr, nullptr) < 0) return film;
    avformat_find_stream_info(input, nullptr);
    const AVStream* stream = input->streams[0];
    const AVCodec* decoder = file.extension() == ".webm" ? avcodec_find_decoder_by_name("libvpx-vp9")
                                                         : avcodec_find_decoder(stream->codecpar->codec_id);
    AVCodecContext* codec = avcodec_alloc_context3(decoder);
    avcodec_parameters_to_context(codec, stream->codecpar);
    avcodec_open2(codec, decoder, nullptr);
    AVPacket* packet = av_packet_alloc();
    AVFrame* frame = av_frame_alloc();
    const auto take = [&] {
        while (avcodec_receive_frame(codec, frame) >= 0) {
            film.width = frame->width;
            film.height = frame->height;
            film.times.push_back(double(frame->pts) * av_q2d(stream->time_base));
            auto& pixels = film.pictures.emplace_back(std::size_t(4) * film.width * film.height);
            SwsContext* scaler = sws_getContext(
                film.width, film.height, static_cast<AVPixelFormat>(frame->format), film.width, film.height,
                AV_PIX_FMT_BGRA, SWS_POINT | SWS_ACCURATE_RND, nullptr, nullptr, nullptr);
            const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
            if (file.extension() == ".webm")
                sws_setColorspaceDetails(scaler, bt709, 0, bt709, 1, 0, 1 << 16, 1 << 16);
            std::uint8_t* to[] = {pixels.data()};
            const int stride[] = {4 * film.width};
            sws_scale(scaler, frame->data, frame->linesize, 0, film.height, to, stride);
            sws_freeContext(scaler);
        }
    };
    while (av_read_frame(input, packet) >= 0) {
        avcodec_send_packet(codec, packet);
        av_packet_unref(packet);
        take();
    }
    avcodec_send_packet(codec, nullptr);
    take();
    av_frame_free(&frame);
    av_packet_free(&packet);
    avcodec_free_context(&codec);
    avformat_close_input(&input);
    return film;
}

constexpr int width = 192, height = 108;

/// A bright bar that wanders to the right; beside it half of a transparent picture is nothing at all, and
/// half is an even colour of half its strength.
Image bar(int k, bool transparent, int w = width, int h = height) {
    Image image(w, h);
    image.transparent = transparent;
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            std::uint8_t* p = image.pixel(x, y);
            const bool lit = x / 16 == k % 12;
            const std::array<int, 4> there =
                transparent ? (y < h / 2 ? std::array{0, 0, 0, 0} : std::array{64, 32, 16, 128})
                            : std::array{46, 18, 16, 0};
            const std::array<int, 4> light{30, 160, 250, 255};
            for (int c = 0; c < 4; ++c) p[c] = static_cast<std::uint8_t>(lit ? light[c] : there[c]);
        }
    return image;
}

void film(const fs::path& file, int frames, Video video) {
    const auto encoder = open_encoder(file, video);
    for (int k = 0; k < frames; ++k) encoder->add(bar(k, video.transparent, video.width, video.height));
    encoder->finish();
}

std::array<int, 4> pixel(const Watched& film, std::size_t k, int x, int y) {
    const std::uint8_t* p = film.pictures.at(k).data() + 4 * (std::size_t(y) * film.width + x);
    return {p[0], p[1], p[2], p[3]};
}

void expect_near(const std::array<int, 4>& found, const std::array<int, 4>& wanted, int tolerance) {
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(found[c], wanted[c], tolerance) << "channel " << c;
}

std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

int count(const std::string& text, const std::string& what) {
    int found = 0;
    for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; ++at) ++found;
    return found;
}

TEST(Formats, EveryFilmHasItsFramesInTheirOrderAtTheirTimes) {
    const TemporaryFolder folder;
    for (const std::string format : {"mp4", "webm", "apng"}) {
        SCOPED_TRACE(format);
        film(folder.path() / ("movie." + format), 40, {.width = width, .height = height, .fps = 20});
        const Watched seen = watch(folder.path() / ("movie." + format));
        ASSERT_EQ(seen.pictures.size(), 40U);
        EXPECT_EQ(seen.width, width);
        EXPECT_EQ(seen.height, height);
        for (const std::size_t k : {0U, 7U, 39U}) {
            EXPECT_NEAR(seen.times[k], double(k) / 20, 1e-3);
            const int lit = static_cast<int>(k % 12) * 16 + 8, dark = static_cast<int>((k + 6) % 12) * 16 + 8;
            if (format == "mp4") continue;  // its colours: tests/film/encoder_test.cpp
            expect_near(pixel(seen, k, lit, 20), {30, 160, 250, 255}, format == "apng" ? 0 : 12);
            expect_near(pixel(seen, k, dark, 20), {46, 18, 16, 255}, format == "apng" ? 0 : 12);
        }
    }
}

TEST(Formats, WebPIsAnAnimationThatRepeats) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "movie.webp";
    film(file, 11, {.width = width, .height = height, .fps = 20});
    // https://developers.google.com/speed/webp/docs/riff_container
    const std::string bytes = bytes_of(file);
    EXPECT_EQ(bytes.substr(0, 4), "RIFF");
    EXPECT_EQ(bytes.substr(8, 8), "WEBPVP8X");
    EXPECT_EQ(static_cast<unsigned char>(bytes[4]) + 256 * static_cast<unsigned char>(bytes[5]),
              static_cast<int>(bytes.size()) - 8);
    EXPECT_EQ(count(bytes, "ANMF"), 11);
    const std::size_t header = bytes.find("ANIM");
    ASSERT_NE(header, bytes.npos);
    EXPECT_EQ(bytes.substr(header + 12, 2), std::string(2, '\0'));  // for ever
    const std::size_t first = bytes.find("ANMF");
    EXPECT_EQ(static_cast<unsigned char>(bytes[first + 8 + 12]), 50);  // (ms)
}

TEST(Formats, TransparentStaysTransparent) {
    const TemporaryFolder folder;
    for (const std::string format : {"webm", "apng"}) {
        SCOPED_TRACE(format);
        film(folder.path() / ("movie." + format), 30,
             {.width = width, .height = height, .transparent = true, .background = {0, 0, 0}});
        const Watched seen = watch(folder.path() / ("movie." + format));
        ASSERT_EQ(seen.pictures.size(), 30U);
        const int tolerance = format == "apng" ? 0 : 14;
        expect_near(pixel(seen, 3, 3 * 16 + 8, 20), {30, 160, 250, 255}, tolerance);
        EXPECT_LE(pixel(seen, 3, 150, 20)[3], tolerance);
        expect_near(pixel(seen, 3, 150, 90), {128, 64, 32, 128}, tolerance);
    }
    film(folder.path() / "movie.webp", 5, {.width = width, .height = height, .transparent = true});
    EXPECT_TRUE(bytes_of(folder.path() / "movie.webp").at(20) & 0x10);  // VP8X: has alpha
}

TEST(Formats, FilmsWithoutAlphaStandOnTheBackground) {
    const TemporaryFolder folder;
    film(folder.path() / "movie.mp4", 30,
         {.width = width, .height = height, .quality = 1, .transparent = true, .background = {0, 1, 0}});
    const Watched seen = watch(folder.path() / "movie.mp4");
    ASSERT_EQ(seen.pictures.size(), 30U);
    const auto nothing = pixel(seen, 3, 150, 20), half = pixel(seen, 3, 150, 90);
    EXPECT_GT(nothing[1], 200);
    EXPECT_LT(nothing[0] + nothing[2], 80);
    EXPECT_NEAR(half[1], 127 + 32, 30);
}

TEST(Formats, GifIsNarrowerAndSlowerWithOnePalette) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "movie.gif";
    film(file, 50, {.width = 1920, .height = 1080, .fps = 25});
    const Watched seen = watch(file);
    EXPECT_EQ(seen.width, 960);
    EXPECT_EQ(seen.height, 540);
    ASSERT_EQ(seen.pictures.size(), 25U);
    EXPECT_NEAR(seen.times[24], 24 * 0.08, 1e-9);
    expect_near(pixel(seen, 3, 6 * 8 + 4, 20), {30, 160, 250, 255}, 2);  // the film's frame 6
    expect_near(pixel(seen, 3, 800, 20), {46, 18, 16, 255}, 2);
    const std::string bytes = bytes_of(file);
    EXPECT_TRUE(bytes.at(10) & 0x80);  // a global palette
    EXPECT_NE(bytes.find("NETSCAPE2.0"), bytes.npos);
}

TEST(Formats, GifHasHolesWhereNothingIs) {
    const TemporaryFolder folder;
    const fs::path file = folder.path() / "movie.gif";
    film(file, 15,
         {.width = width, .height = height, .fps = 15, .transparent = true, .background = {1, 1, 1}});
    const Watched seen = watch(file);
    ASSERT_EQ(seen.pictures.size(), 15U);
    for (const std::size_t k : {0U, 3U, 10U}) {
        EXPECT_EQ(pixel(seen, k, 120, 20)[3], 0);
        EXPECT_EQ(pixel(seen, k, static_cast<int>(k) * 16 + 8, 20)[3], 255);
        expect_near(pixel(seen, k, 184, 90), {64 + 127, 32 + 127, 16 + 127, 255}, 3);  // half of it on white
    }
}

TEST(Formats, GifKeepsItsLimit) {
    const TemporaryFolder folder;
    const auto noise = [](int k) {
        Image image(320, 180);
        std::uint32_t state = 1 + k;
        for (std::uint8_t& byte : image.bgra)
            byte = static_cast<std::uint8_t>((state = state * 1664525 + 1013904223) >> 24);
        return image;
    };
    std::map<double, std::uintmax_t> sizes;
    for (const double limit : {1e9, 3e5, 1.5e5}) {
        const fs::path file = folder.path() / "movie.gif";
        const auto encoder = open_encoder(file, {.width = 320, .height = 180, .fps = 15, .gif_limit = limit});
        for (int k = 0; k < 15; ++k) encoder->add(noise(k));
        encoder->finish();
        sizes[limit] = fs::file_size(file);
    }
    EXPECT_GT(sizes[1e9], 5e5);
    EXPECT_LE(sizes[3e5], 3e5);
    EXPECT_GT(sizes[3e5], 6e4);  // no smaller than need be
    EXPECT_LE(sizes[1.5e5], 1.5e5);
}

TEST(Formats, EveryFilmSaysWhereItIsFrom) {
    const TemporaryFolder folder;
    const std::string comment = "hibi <ひび> & " + std::string(600, 'x') + " end";
    for (const std::string& format : film_formats()) {
        SCOPED_TRACE(format);
        const fs::path file = folder.path() / ("movie." + format);
        film(file, 12, {.width = width, .height = height, .metadata = {{"comment", comment}}});
        if (format == "webp") {
            const std::string bytes = bytes_of(file);
            EXPECT_NE(bytes.find("XMP "), bytes.npos);
            EXPECT_NE(bytes.find("hibi &lt;ひび> &amp; xxx"), bytes.npos);
            EXPECT_TRUE(bytes.at(20) & 0x04);
            EXPECT_EQ(bytes.size() % 2, 0U);
        } else if (format == "apng") {
            PngText text;
            read_png(file, &text);
            EXPECT_EQ(text["Comment"], comment);
        } else {
            std::string found;
            for (const auto& [key, value] : film_metadata(file))
                if (key == "comment" || key == "COMMENT") found = value;
            EXPECT_EQ(found, comment);
        }
        EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
        fs::remove(file);
    }
}

TEST(Formats, WhatIsNoFilmIsSaid) {
    const TemporaryFolder folder;
    try {
        open_encoder(folder.path() / "movie.avi", {.width = width, .height = height});
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("no film format has the extension \".avi\""),
                  std::string::npos);
    }
    for (const std::string& format : film_formats())
        EXPECT_THROW(
            open_encoder(folder.path() / ("movie." + format), {.width = width, .height = height})->finish(),
            std::runtime_error)
            << format;
}

}  // namespace
}  // namespace hibi
