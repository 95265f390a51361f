#include "pictures/draw.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/hash.hpp"
#include "base/profile.hpp"
#include "film/encoder.hpp"
#include "image/png.hpp"
#include "pictures/frame_writer.hpp"
#include "scene/read.hpp"
#include "support/recorded_cantilever.hpp"
#include "support/temporary_folder.hpp"

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace hibi {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Json frames_of(const fs::path& folder) { return Json::parse(std::ifstream(folder / "frames.json")); }

/// Number of pictures in a film's first stream.
int packets(const fs::path& film) {
    AVFormatContext* input = nullptr;
    if (avformat_open_input(&input, film.c_str(), nullptr, nullptr) < 0) return -1;
    AVPacket* packet = av_packet_alloc();
    int count = 0;
    while (av_read_frame(input, packet) >= 0) {
        ++count;
        av_packet_unref(packet);
    }
    av_packet_free(&packet);
    avformat_close_input(&input);
    return count;
}

/// Mean luma of each picture of a film, in the order of showing.
std::vector<double> brightness(const fs::path& film) {
    AVFormatContext* input = nullptr;
    if (avformat_open_input(&input, film.c_str(), nullptr, nullptr) < 0) return {};
    avformat_find_stream_info(input, nullptr);
    const AVCodec* decoder = avcodec_find_decoder(input->streams[0]->codecpar->codec_id);
    AVCodecContext* codec = avcodec_alloc_context3(decoder);
    avcodec_parameters_to_context(codec, input->streams[0]->codecpar);
    avcodec_open2(codec, decoder, nullptr);
    AVPacket* packet = av_packet_alloc();
    AVFrame* frame = av_frame_alloc();
    std::vector<double> means;
    const auto take = [&] {
        while (avcodec_receive_frame(codec, frame) >= 0) {
            double sum = 0;
            for (int y = 0; y < frame->height; ++y)
                for (int x = 0; x < frame->width; ++x) sum += frame->data[0][y * frame->linesize[0] + x];
            means.push_back(sum / (frame->width * frame->height));
        }
    };
    while (av_read_frame(input, packet) >= 0) {
        avcodec_send_packet(codec, packet);
        take();
        av_packet_unref(packet);
    }
    avcodec_send_packet(codec, nullptr);
    take();
    av_frame_free(&frame);
    av_packet_free(&packet);
    avcodec_free_context(&codec);
    avformat_close_input(&input);
    return means;
}

TEST(Draw, FramesFilmAndPosterAgreeWithTheRecord) {
    const TemporaryFolder folder;
    const RecordedCantilever cantilever;
    cantilever.write(folder.path());
    int last_progress = 0;
    const DrawResult result =
        draw_run(cantilever.scene(), folder.path(), {.progress = [&](int done, int total) {
                     EXPECT_EQ(done, last_progress + 1);
                     EXPECT_EQ(total, 20);
                     last_progress = done;
                 }});
    EXPECT_EQ(result.frames, 20);  // 2 s at 10 frames per second
    EXPECT_EQ(last_progress, 20);
    EXPECT_EQ(packets(folder.path() / "movie.mp4"), 20);

    const Json frames = frames_of(folder.path());
    ASSERT_EQ(frames.size(), 20u);
    double before = -1;
    std::map<std::string, double> event_times;
    for (const Json& frame : frames) {
        const fs::path file = folder.path() / frame["file"].get<std::string>();
        PngText text;
        EXPECT_EQ(pixel_hash(read_png(file, &text)), frame["sha256"]);
        EXPECT_EQ(text["Title"], "Cantilever");
        EXPECT_EQ(text["Scene hash"], "0123abcd");
        EXPECT_NEAR(std::stod(text["Time"]), frame["time"].get<double>(), 1e-8);
        const double time = frame["time"];
        EXPECT_GT(time, before);
        if (!frame["event"].is_null()) {
            event_times[frame["event"]] = time;
            const std::map<std::string, double> happened = {
                {"start", 0}, {"first_break", 1.0}, {"peak_load", 1.2}, {"separation", 1.5}, {"end", 2.0}};
            ASSERT_TRUE(happened.contains(frame["event"]));
            EXPECT_GE(time, happened.at(frame["event"]));
            EXPECT_LT(before, happened.at(frame["event"]));
        }
        before = time;
    }
    EXPECT_EQ(event_times.size(), 5u);
    EXPECT_EQ(read_png(folder.path() / "poster.png").width, 320);
}

TEST(Draw, ThePictureChangesWhenABondBreaksAndShowsTheFirstOne) {
    const TemporaryFolder folder;
    RecordedCantilever cantilever;
    cantilever.write(folder.path());
    Scene scene = cantilever.scene();
    scene.view.show = {};  // the body alone
    draw_run(scene, folder.path(), {.movie = false});
    const Json frames = frames_of(folder.path());
    // Crack colours are nowhere in the body: count nearly white and strongly pink pixels.
    const auto cracked = [&](const Json& frame) {
        const Image image = read_png(folder.path() / frame["file"].get<std::string>());
        int count = 0;
        for (int i = 0; i < image.width * image.height; ++i) {
            const int b = image.bgra[4 * i], g = image.bgra[4 * i + 1], r = image.bgra[4 * i + 2];
            count += (r > 225 && g < 110 && b > 100) || (r > 225 && g > 225 && b > 235);
        }
        return count;
    };
    for (const Json& frame : frames) {
        const double time = frame["time"];
        if (time < 1.0) {
            EXPECT_EQ(cracked(frame), 0) << time;
        } else if (time > 1.1 && time < 1.5) {
            EXPECT_GT(cracked(frame), 10) << time;
        }
    }
}

TEST(Draw, TheSameHashesTwiceAndForAnyNumberOfWorkers) {
    const TemporaryFolder folder;
    const RecordedCantilever cantilever;
    cantilever.write(folder.path());
    draw_run(cantilever.scene(), folder.path(), {.movie = false, .workers = 1});
    const Json first = frames_of(folder.path());
    ASSERT_EQ(first.size(), 20u);
    ASSERT_NE(first[0]["sha256"], first[19]["sha256"]);
    for (const int workers : {1, 2, 3}) {
        draw_run(cantilever.scene(), folder.path(), {.movie = workers == 2, .workers = workers});
        EXPECT_EQ(frames_of(folder.path()), first) << workers;
    }
}

TEST(Draw, TheSetupShowsSupportsAndLoadsWithoutARun) {
    const TemporaryFolder folder;
    Scene scene = read_scene(fs::path(HIBI_SOURCE_DIR) / "scenes" / "bending_coarse.toml");
    scene.view.width = 320;
    scene.view.height = 180;
    const auto setup = [&](std::vector<std::string> show) {
        scene.view.show = std::move(show);
        draw_setup({scene, build(scene)}, folder.path() / "setup.png", {});
        return read_png(folder.path() / "setup.png");
    };
    const Image with = setup({"title", "supports", "loads"});
    EXPECT_EQ(with.width, 320);
    EXPECT_EQ(with.height, 180);
    const auto pixels_of = [](const Image& image, const Rgb& colour) {
        int count = 0;
        for (int i = 0; i < image.width * image.height; ++i) {
            bool same = true;
            for (int c = 0; c < 3; ++c)
                same = same && std::abs(image.bgra[4 * i + c] - 255 * colour[2 - c]) < 1.5;
            count += same;
        }
        return count;
    };
    const Theme& colours = theme(scene.view.theme);
    EXPECT_GT(pixels_of(with, colours.load), 10);
    EXPECT_GT(pixels_of(with, colours.support), 10);
    EXPECT_EQ(pixel_hash(setup({"title", "supports", "loads", "time", "colour_bar", "curve"})),
              pixel_hash(with));
    const Image without = setup({"title"});
    EXPECT_EQ(pixels_of(without, colours.load), 0);
    EXPECT_EQ(pixels_of(without, colours.support), 0);
}

TEST(Draw, ATransparentFrameOnTheThemesBackgroundIsTheOpaqueOne) {
    const TemporaryFolder folder;
    const RecordedCantilever cantilever;
    cantilever.write(folder.path());
    Scene scene = cantilever.scene();
    for (const std::string name : {"dark", "light"}) {
        scene.view.theme = name;
        scene.view.transparent = false;
        draw_run(scene, folder.path(), {.movie = false});
        std::vector<Image> opaque;
        for (const int k : {0, 12, 19})
            opaque.push_back(read_png(folder.path() / "frames" / fmt::format("{:06}.png", k)));
        scene.view.transparent = true;
        draw_run(scene, folder.path(), {.movie = false});
        std::size_t i = 0;
        for (const int k : {0, 12, 19}) {
            const Image image = read_png(folder.path() / "frames" / fmt::format("{:06}.png", k));
            ASSERT_TRUE(image.transparent);
            EXPECT_EQ(image.pixel(0, 0)[3], 0);
            const Image laid = laid_on(image, theme(name).background);
            int worst = 0;
            for (std::size_t b = 0; b < laid.bgra.size(); ++b)
                if (b % 4 != 3) worst = std::max(worst, std::abs(laid.bgra[b] - opaque[i].bgra[b]));
            EXPECT_LE(worst, 3) << name << " " << k;  // rounding, in each of what lies one over the other
            ++i;
        }
    }
}

TEST(Draw, FilmsComeInTheFormatsAskedForAndGoAgain) {
    const TemporaryFolder folder;
    const RecordedCantilever cantilever;
    cantilever.write(folder.path());
    Scene scene = cantilever.scene();
    scene.movie.formats = {"gif", "webm"};
    draw_run(scene, folder.path(), {.frames = false});
    EXPECT_EQ(packets(folder.path() / "movie.gif"), 20);
    EXPECT_EQ(packets(folder.path() / "movie.webm"), 20);
    EXPECT_FALSE(fs::exists(folder.path() / "movie.mp4"));
    EXPECT_EQ(film_in(folder.path()), "movie.gif");
    DrawOptions every_format;
    every_format.formats = film_formats();
    every_format.frames = false;
    draw_run(scene, folder.path(), every_format);
    for (const std::string& format : film_formats())
        EXPECT_TRUE(fs::exists(folder.path() / ("movie." + format)));
    EXPECT_EQ(film_in(folder.path()), "movie.mp4");
    every_format.formats = {"gif"};
    draw_run(scene, folder.path(), every_format);  // one more of these costs none of the others
    EXPECT_TRUE(fs::exists(folder.path() / "movie.webm"));
    draw_run(scene, folder.path(), {.movie = false, .frames = false});
    EXPECT_EQ(film_in(folder.path()), "");  // record/leftovers knows them all
}

TEST(Draw, OldPicturesGoAndEverythingElseStays) {
    const TemporaryFolder folder;
    const RecordedCantilever cantilever;
    cantilever.write(folder.path());
    const auto touch = [&](const char* name) {
        fs::create_directories((folder.path() / name).parent_path());
        std::ofstream(folder.path() / name) << "old";
    };
    for (const char* name :
         {"frames/000099.png", "frames/000100.png.tmp", "movie.mp4", "frames/notes.png", "frames/000003.txt"})
        touch(name);
    draw_run(cantilever.scene(), folder.path(), {.movie = false, .frames = false});
    EXPECT_FALSE(fs::exists(folder.path() / "frames/000099.png"));
    EXPECT_FALSE(fs::exists(folder.path() / "frames/000100.png.tmp"));
    EXPECT_FALSE(fs::exists(folder.path() / "movie.mp4"));
    EXPECT_FALSE(fs::exists(folder.path() / "frames.json"));
    EXPECT_TRUE(fs::exists(folder.path() / "poster.png"));  // the only picture asked for
    EXPECT_TRUE(fs::exists(folder.path() / "frames/notes.png"));
    EXPECT_TRUE(fs::exists(folder.path() / "frames/000003.txt"));
}

TEST(FrameWriter, AnErrorOfAWorkerReachesTheCaller) {
    const TemporaryFolder folder;  // without frames/: no PNG can be written
    FrameWriter writer(folder.path(), 2, {}, {.width = 32, .height = 18});
    try {
        for (int k = 0; k < 50; ++k) {  // more than it holds: waiting for a free image must not hang
            FrameInfo info;
            info.file = "frames/000000.png";
            writer.add(writer.take(), info, {});
        }
        writer.finish();
        FAIL() << "no error";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("frames/000000.png"), std::string::npos) << error.what();
    }
}

TEST(FrameWriter, KeepsTheOrderHoweverLongAFrameTakes) {
    const TemporaryFolder folder;
    fs::create_directories(folder.path() / "frames");
    FrameWriter writer(folder.path(), 3, {"mp4"}, {.width = 320, .height = 180, .fps = 10});
    for (int k = 0; k < 30; ++k) {
        Image image = writer.take();
        for (std::size_t i = 0; i < image.bgra.size();
             ++i)  // brighter and brighter; noise costs the encoder time
            image.bgra[i] = static_cast<std::uint8_t>(6 * k + static_cast<int>(mix_bits(i) % 32));
        FrameInfo info;
        info.file = "frames/" + std::to_string(k) + ".png";
        info.time = k;
        writer.add(std::move(image), info, {});
    }
    const std::vector<FrameInfo> done = writer.finish();
    ASSERT_EQ(done.size(), 30u);
    for (int k = 0; k < 30; ++k) {
        EXPECT_EQ(done[k].time, k);
        EXPECT_EQ(done[k].sha256, pixel_hash(read_png(folder.path() / done[k].file)));
    }
    const std::vector<double> film = brightness(folder.path() / "movie.mp4");
    ASSERT_EQ(film.size(), 30u);
    for (int k = 1; k < 30; ++k) EXPECT_GT(film[k], film[k - 1]) << k;
    EXPECT_GT(writer.encode_seconds(), 0);
}

TEST(FrameWriter, BeingLeftUnfinishedStopsItsThreads) {
    const TemporaryFolder folder;
    fs::create_directories(folder.path() / "frames");
    {
        FrameWriter writer(folder.path(), 2, {"mp4"}, {.width = 64, .height = 36, .fps = 10});
        FrameInfo info;
        info.file = "frames/000000.png";
        writer.add(writer.take(), info, {});
    }
    EXPECT_FALSE(fs::exists(folder.path() / "movie.mp4"));
}

TEST(Draw, ProfileCountsEveryStageOfEveryFrameAndChangesNoPixel) {
    const TemporaryFolder plain, measured;
    const RecordedCantilever cantilever;
    StageTimes times = drawing_stages();
    cantilever.write(plain.path());
    cantilever.write(measured.path());
    const DrawResult result =
        draw_run(cantilever.scene(), measured.path(), {.renderer = {.profile = &times}});
    draw_run(cantilever.scene(), plain.path(), {});
    EXPECT_EQ(frames_of(measured.path()), frames_of(plain.path()));
    std::map<std::string, std::int64_t> calls;
    for (const StageTime& stage : times.list()) calls[stage.name] = stage.calls;
    for (const char* stage : {"interpolate", "place symbols", "upload", "draw calls", "rasterise",
                              "read back", "overlay", "wait for the writers", "hash", "write PNG", "encode"})
        EXPECT_EQ(calls[stage], 20) << stage;
    EXPECT_EQ(calls["write poster"], 1);
    EXPECT_GT(result.processor_seconds, 0);
}

}  // namespace
}  // namespace hibi
