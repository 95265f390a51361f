#include "app/draw.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "app/frame_writer.hpp"
#include "app/recorded_cantilever.hpp"
#include "image/png.hpp"
#include "support/temporary_folder.hpp"

extern "C" {
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
    FrameWriter writer(folder.path(), 2, {}, 32, 18);
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
    FrameWriter writer(folder.path(), 3, Video{.width = 64, .height = 36, .fps = 10}, 64, 36);
    for (int k = 0; k < 30; ++k) {
        Image image = writer.take();
        for (std::size_t i = 0; i < image.bgra.size(); ++i)
            image.bgra[i] = static_cast<std::uint8_t>(k % 3 == 0 ? i * i * 31 + i / 7 : k);
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
    EXPECT_EQ(packets(folder.path() / "movie.mp4"), 30);
    EXPECT_GT(writer.encode_seconds(), 0);
}

TEST(FrameWriter, BeingLeftUnfinishedStopsItsThreads) {
    const TemporaryFolder folder;
    fs::create_directories(folder.path() / "frames");
    {
        FrameWriter writer(folder.path(), 2, Video{.width = 64, .height = 36, .fps = 10}, 64, 36);
        FrameInfo info;
        info.file = "frames/000000.png";
        writer.add(writer.take(), info, {});
    }
    EXPECT_FALSE(fs::exists(folder.path() / "movie.mp4"));
}

}  // namespace
}  // namespace hibi
