#include "film/encoder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "film/remux.hpp"
#include "image/image.hpp"

namespace hibi {
namespace {

namespace fs = std::filesystem;

constexpr int width = 192, height = 108, fps = 25;

struct Seen {
    int frames = 0, keys = 0, width = 0, height = 0;
    double start = 0, duration = 0, rate = 0;
    bool even_times = true;
    std::string codec, title;
    AVPixelFormat format = AV_PIX_FMT_NONE;
    std::array<int, 4> tags{};    ///< range, primaries, transfer, matrix
    std::array<double, 3> yuv{};  ///< mean of the frame's left upper quarter, last frame
};

/// Decodes a whole film with the libraries.
std::optional<Seen> watch(const fs::path& file) {
    AVFormatContext* input = nullptr;
    if (avformat_open_input(&input, file.c_str(), nullptr, nullptr) < 0) return {};
    avformat_find_stream_info(input, nullptr);
    const AVStream* stream = input->streams[0];
    const AVCodec* decoder = avcodec_find_decoder(stream->codecpar->codec_id);
    AVCodecContext* codec = avcodec_alloc_context3(decoder);
    avcodec_parameters_to_context(codec, stream->codecpar);
    avcodec_open2(codec, decoder, nullptr);
    Seen seen;
    AVPacket* packet = av_packet_alloc();
    AVFrame* frame = av_frame_alloc();
    const auto take = [&] {
        while (avcodec_receive_frame(codec, frame) >= 0) {
            const double time = double(frame->pts) * av_q2d(stream->time_base);
            seen.even_times = seen.even_times && std::abs(time - double(seen.frames) / fps) < 1e-6;
            ++seen.frames;
            for (int plane = 0; plane < 3; ++plane) {
                const int w = width / (plane ? 4 : 2), h = height / (plane ? 4 : 2);
                double sum = 0;
                for (int y = 0; y < h; ++y)
                    for (int x = 0; x < w; ++x) sum += frame->data[plane][y * frame->linesize[plane] + x];
                seen.yuv[plane] = sum / (w * h);
            }
        }
    };
    while (av_read_frame(input, packet) >= 0) {
        seen.keys += packet->flags & AV_PKT_FLAG_KEY ? 1 : 0;
        avcodec_send_packet(codec, packet);
        av_packet_unref(packet);
        take();
    }
    avcodec_send_packet(codec, nullptr);
    take();
    seen.width = codec->width;
    seen.height = codec->height;
    seen.start = double(stream->start_time) * av_q2d(stream->time_base);
    seen.duration = double(input->duration) / AV_TIME_BASE;
    seen.rate = av_q2d(stream->avg_frame_rate);
    seen.codec = decoder->name;
    seen.format = codec->pix_fmt;
    seen.tags = {codec->color_range, codec->color_primaries, codec->color_trc, codec->colorspace};
    if (const auto* title = av_dict_get(input->metadata, "title", nullptr, 0)) seen.title = title->value;
    av_frame_free(&frame);
    av_packet_free(&packet);
    avcodec_free_context(&codec);
    avformat_close_input(&input);
    return seen;
}

/// A flat colour with a bar that wanders through the lower half.
Image frame(int k, std::array<int, 3> rgb) {
    Image image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                image.pixel(x, y)[c] =
                    y > height / 2 + 8 && x / 8 == k % 20 ? 255 : static_cast<std::uint8_t>(rgb[2 - c]);
    return image;
}

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

class EncoderTest : public testing::Test {
 protected:
    EncoderTest() {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    ~EncoderTest() override { fs::remove_all(folder); }

    void film(int frames, std::array<int, 3> rgb = {200, 60, 30}) const {
        const auto encoder =
            open_encoder(file, {.width = width, .height = height, .metadata = {{"title", "ひび"}}});
        for (int k = 0; k < frames; ++k) {
            const Image image = frame(k, rgb);
            encoder->add(image);
        }
        encoder->finish();
    }
    static std::string error_of(const std::function<void()>& act) {
        try {
            act();
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    }

    fs::path folder = fs::temp_directory_path() / ("hibi_encoder_test_" + std::to_string(getpid()));
    fs::path file = folder / "movie.mp4";
};

TEST_F(EncoderTest, FilmHasTheFramesTheRateAndTheTags) {
    film(60);
    const auto seen = watch(file);
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->codec, "h264");
    EXPECT_EQ(seen->frames, 60);
    EXPECT_EQ(seen->width, width);
    EXPECT_EQ(seen->height, height);
    EXPECT_EQ(seen->start, 0);
    EXPECT_TRUE(seen->even_times);
    EXPECT_NEAR(seen->duration, 60.0 / fps, 1e-3);
    EXPECT_EQ(seen->rate, fps);
    EXPECT_GE(seen->keys, 3);  // at 0, 25, 50
    EXPECT_EQ(seen->format, AV_PIX_FMT_YUV420P);
    EXPECT_EQ(seen->tags,
              (std::array<int, 4>{AVCOL_RANGE_MPEG, AVCOL_PRI_BT709, AVCOL_TRC_BT709, AVCOL_SPC_BT709}));
    EXPECT_EQ(seen->title, "ひび");
}

TEST_F(EncoderTest, FilmOfOneFramePlays) {
    film(1);
    const auto seen = watch(file);
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->frames, 1);
    EXPECT_NEAR(seen->duration, 1.0 / fps, 1e-3);
}

TEST_F(EncoderTest, ColoursSurvive) {
    for (const std::array<int, 3> rgb :
         {std::array{16, 18, 23}, {200, 60, 30}, {252, 255, 164}, {93, 18, 110}, {255, 255, 255}}) {
        film(30, rgb);
        const auto seen = watch(file);
        ASSERT_TRUE(seen);
        // ITU-R BT.709-6, 3: limited-range Y'CbCr to R'G'B'.
        const double y = (seen->yuv[0] - 16) / 219, cb = (seen->yuv[1] - 128) / 224,
                     cr = (seen->yuv[2] - 128) / 224;
        EXPECT_NEAR(255 * (y + 1.5748 * cr), rgb[0], 2);
        EXPECT_NEAR(255 * (y - 0.1873 * cb - 0.4681 * cr), rgb[1], 2);
        EXPECT_NEAR(255 * (y + 1.8556 * cb), rgb[2], 2);
    }
}

TEST_F(EncoderTest, FinishedFilmHasItsIndexInFrontAndLeavesNothingElse) {
    film(30);
    const std::string bytes = text_of(file);
    EXPECT_LT(bytes.find("moov"), bytes.find("mdat"));
    EXPECT_EQ(bytes.find("moof"), bytes.npos);  // no longer in fragments
    EXPECT_EQ(std::distance(fs::directory_iterator(folder), {}), 1);
}

TEST_F(EncoderTest, KilledFilmPlaysFromItsTemporaryName) {
    {
        const auto encoder = open_encoder(file, {.width = width, .height = height});
        for (int k = 0; k < 90; ++k) {
            const Image image = frame(k, {200, 60, 30});
            encoder->add(image);
        }
    }
    EXPECT_FALSE(fs::exists(file));
    const auto seen = watch(folder / "movie.part.mp4");
    ASSERT_TRUE(seen);
    EXPECT_GE(seen->frames, 25);  // one second was complete
    EXPECT_TRUE(seen->even_times);
}

TEST_F(EncoderTest, NewFilmReplacesAnOldOne) {
    film(40);
    film(10);
    const auto seen = watch(file);
    ASSERT_TRUE(seen);
    EXPECT_EQ(seen->frames, 10);
}

TEST_F(EncoderTest, OddSizeIsRefused) {
    const std::string error = error_of([&] { open_encoder(file, {.width = 191, .height = 108}); });
    EXPECT_NE(error.find(file.string()), error.npos) << error;
    EXPECT_NE(error.find("even"), error.npos) << error;
    EXPECT_NE(error.find("191 x 108"), error.npos) << error;
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST_F(EncoderTest, FolderThatIsNotThereIsNamed) {
    const fs::path nowhere = folder / "missing" / "movie.mp4";
    const std::string error = error_of([&] { open_encoder(nowhere, {.width = width, .height = height}); });
    EXPECT_NE(error.find(nowhere.string()), error.npos) << error;
    EXPECT_NE(error.find("No such file or directory"), error.npos) << error;
}

TEST_F(EncoderTest, FilmOfNoFramesIsAnError) {
    const std::string error = error_of([&] { film(0); });
    EXPECT_NE(error.find("no frames"), error.npos) << error;
}

TEST(EncoderName, NamesTheEncoderAndItsVersion) {
    EXPECT_TRUE(encoder_name().starts_with("libx264, FFmpeg "));
}

}  // namespace
}  // namespace hibi
