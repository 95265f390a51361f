#include "film/encoder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "film/comment.hpp"
#include "film/gif.hpp"
#include "film/stream.hpp"

namespace hibi {
namespace {

/// How a format is made: from pixels of `opaque`, or of `transparent` where it has them.
struct Format {
    const char *name, *muxer, *codec;
    AVPixelFormat opaque, transparent;
    Settings encoder, file;
};

const std::vector<Format>& formats() {
    static const std::vector<Format> list{
        // A fragment per key frame: whatever kills the program, all but the last second can be played. The
        // header waits for the first one, since only then the edit list that aligns the frames is known.
        {"mp4",
         "mp4",
         "libx264",
         AV_PIX_FMT_YUV420P,
         AV_PIX_FMT_NONE,
         {{"preset", "veryfast"}},
         {{"movflags", "frag_keyframe+delay_moov+default_base_moof"}}},
        // libvpx refuses alternate reference frames in films with alpha.
        {"webm",
         "webm",
         "libvpx-vp9",
         AV_PIX_FMT_YUV420P,
         AV_PIX_FMT_YUVA420P,
         {{"deadline", "good"},
          {"cpu-used", "5"},
          {"row-mt", "1"},
          {"tile-columns", "2"},
          {"crf", "28"},
          {"b", "0"},
          {"auto-alt-ref", "0"}},
         {}},
        {"apng", "apng", "apng", AV_PIX_FMT_RGB24, AV_PIX_FMT_RGBA, {{"pred", "up"}}, {{"plays", "0"}}},
        {"webp",
         "webp",
         "libwebp_anim",
         AV_PIX_FMT_BGRA,
         AV_PIX_FMT_BGRA,
         {{"quality", "80"}, {"compression_level", "2"}},
         {{"loop", "0"}}},
    };
    return list;
}

bool is_yuv(AVPixelFormat format) { return format == AV_PIX_FMT_YUV420P || format == AV_PIX_FMT_YUVA420P; }

/// Any format but GIF.
class VideoEncoder : public Encoder {
 public:
    VideoEncoder(const Format& format, std::filesystem::path name, const Video& wanted)
        : file(std::move(name)), part(film_part_name(file)), video(wanted), stream(part, file) {
        if (video.width <= 0 || video.height <= 0 || video.width % 2 || video.height % 2)
            stream.fail(
                fmt::format("a film needs an even width and height (H.264 halves its colours); found {} x {}",
                            video.width, video.height));
        transparent = video.transparent && format.transparent != AV_PIX_FMT_NONE;
        const AVPixelFormat pixels = transparent ? format.transparent : format.opaque;
        has_alpha = pixels != AV_PIX_FMT_YUV420P && pixels != AV_PIX_FMT_RGB24;
        AVCodecContext& codec = stream.codec(format.codec, video.width, video.height, pixels, {video.fps, 1});
        codec.gop_size = video.fps;  // a second: a player finds any place at once
        codec.thread_count = video.threads;
        if (is_yuv(pixels)) {
            codec.color_primaries = AVCOL_PRI_BT709;
            codec.color_trc = AVCOL_TRC_BT709;
            codec.colorspace = AVCOL_SPC_BT709;
            codec.color_range = AVCOL_RANGE_MPEG;
            codec.chroma_sample_location = AVCHROMA_LOC_LEFT;
        }
        Settings settings = format.encoder;
        if (is_mp4()) settings["crf"] = std::to_string(video.quality);
        frame = make_frame(video.width, video.height, pixels);
        frame->color_primaries = codec.color_primaries;
        frame->color_trc = codec.color_trc;
        frame->colorspace = codec.colorspace;
        frame->color_range = codec.color_range;
        frame->chroma_location = codec.chroma_sample_location;
        make_scaler(pixels);
        stream.begin(format.muxer, settings, format.file, video.metadata);
    }

    void add(const Image& image) override {
        // The encoder may still hold the last frame's memory.
        stream.check(av_frame_make_writable(frame.get()), "reserve memory");
        const std::uint8_t* from[] = {pixels_of(image)};
        const int from_stride[] = {4 * video.width};
        sws_scale(scaler.get(), from, from_stride, 0, video.height, frame->data, frame->linesize);
        frame->pts = frames++;
        stream.send(frame.get());
    }

    void finish() override {
        if (frames == 0) stream.fail("cannot make a film of no frames");
        stream.finish();
        if (is_mp4()) return finish_film(part, file, video.fps);
        if (file.extension() != ".webm" && video.metadata.contains("comment"))
            write_film_comment(part, video.metadata.at("comment"));
        rename_film(part, file);
    }

 private:
    /// B, G, R, alpha, not multiplied by alpha.
    const std::uint8_t* pixels_of(const Image& image) {
        // Without alpha in the film nobody looks at the fourth byte.
        if (!image.transparent && !has_alpha) return image.bgra.data();
        straight.resize(image.bgra.size());
        if (image.transparent && !transparent)
            to_straight(laid_on(image, video.background), straight.data());
        else
            to_straight(image, straight.data(), video.background);
        return straight.data();
    }

    bool is_mp4() const { return file.extension() == ".mp4"; }

    void make_scaler(AVPixelFormat pixels) {
        scaler.reset(sws_getContext(video.width, video.height, AV_PIX_FMT_BGRA, video.width, video.height,
                                    pixels, SWS_BILINEAR | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
        if (!scaler) stream.fail("cannot convert the colours");
        if (!is_yuv(pixels)) return;
        // Left alone, swscale uses BT.601, and a player that believes the tags shows other colours.
        const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
        const int full = 1, limited = 0, plain = 1 << 16;
        if (sws_setColorspaceDetails(scaler.get(), bt709, full, bt709, limited, 0, plain, plain) < 0)
            stream.fail("cannot convert the colours to BT.709");
    }

    std::filesystem::path file, part;
    Video video;
    FilmStream stream;
    bool transparent = false;
    bool has_alpha = true;  ///< the pixels of the film
    std::int64_t frames = 0;
    std::vector<std::uint8_t> straight;
    FramePtr frame;
    ScalerPtr scaler;
};

}  // namespace

const std::vector<std::string>& film_formats() {
    static const std::vector<std::string> names{"mp4", "gif", "webm", "apng", "webp"};
    return names;
}

std::unique_ptr<Encoder> open_encoder(const std::filesystem::path& file, const Video& video) {
    const std::string name = file.extension().string();
    if (name == ".gif") return std::make_unique<GifEncoder>(file, video);
    for (const Format& format : formats())
        if (name == std::string(".") + format.name)
            return std::make_unique<VideoEncoder>(format, file, video);
    throw std::runtime_error(fmt::format("{}: no film format has the extension \"{}\"", file.string(), name));
}

std::string encoder_name() {
    return avcodec_find_encoder_by_name("libx264") ? fmt::format("libx264, FFmpeg {}", av_version_info())
                                                   : "";
}

}  // namespace hibi
