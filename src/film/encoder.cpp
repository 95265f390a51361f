#include "film/encoder.hpp"

#include <fmt/format.h>

#include <cassert>
#include <stdexcept>

#include "film/remux.hpp"

extern "C" {
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

namespace hibi {
namespace {

constexpr int frames_between_keys = 25;  // a second: a player finds any place at once

struct FreeCodec {
    void operator()(AVCodecContext* p) const { avcodec_free_context(&p); }
};
struct FreeFrame {
    void operator()(AVFrame* p) const { av_frame_free(&p); }
};
struct FreeScaler {
    void operator()(SwsContext* p) const { sws_freeContext(p); }
};

const AVCodec* x264() { return avcodec_find_encoder_by_name("libx264"); }

}  // namespace

struct Encoder::Impl {
    Impl(std::filesystem::path name, const Video& wanted)
        : file(std::move(name)), part(film_part_name(file)), video(wanted) {
        av_log_set_level(AV_LOG_QUIET);  // what goes wrong is thrown, not printed between the progress lines
        if (video.width <= 0 || video.height <= 0 || video.width % 2 || video.height % 2)
            fail(
                fmt::format("a film needs an even width and height (H.264 halves its colours); found {} x {}",
                            video.width, video.height));
        open_codec();
        make_frame();
        output = create_film(part, file);
        output->flags |= AVFMT_FLAG_FLUSH_PACKETS;  // a fragment that is complete stands on the disk
        AVStream* stream = add_film_stream(*output, video.metadata);
        check(avcodec_parameters_from_context(stream->codecpar, codec.get()), "describe the video");
        set_film_rate(*stream, video.fps);
        // A fragment per key frame: whatever kills the program, all but the last second can be played. The
        // header waits for the first one, since only then the edit list that aligns the frames is known.
        AVDictionary* options = nullptr;
        av_dict_set(&options, "movflags", "frag_keyframe+delay_moov+default_base_moof", 0);
        const int error = avformat_write_header(output.get(), &options);
        av_dict_free(&options);
        check(error, "begin the film");
    }

    void open_codec() {
        const AVCodec* encoder = x264();
        if (!encoder) fail("cannot open encoder \"libx264\": not in this build of FFmpeg");
        codec.reset(avcodec_alloc_context3(encoder));
        codec->width = video.width;
        codec->height = video.height;
        codec->pix_fmt = AV_PIX_FMT_YUV420P;
        codec->time_base = {1, video.fps};
        codec->framerate = {video.fps, 1};
        codec->sample_aspect_ratio = {1, 1};
        codec->gop_size = frames_between_keys;
        codec->thread_count = video.threads;
        codec->color_primaries = AVCOL_PRI_BT709;
        codec->color_trc = AVCOL_TRC_BT709;
        codec->colorspace = AVCOL_SPC_BT709;
        codec->color_range = AVCOL_RANGE_MPEG;
        codec->chroma_sample_location = AVCHROMA_LOC_LEFT;
        codec->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
        av_opt_set(codec->priv_data, "preset", "veryfast", 0);
        av_opt_set_int(codec->priv_data, "crf", video.quality, 0);
        check(avcodec_open2(codec.get(), encoder, nullptr), "open encoder \"libx264\"");
    }

    void make_frame() {
        frame.reset(av_frame_alloc());
        frame->format = codec->pix_fmt;
        frame->width = video.width;
        frame->height = video.height;
        frame->color_primaries = codec->color_primaries;
        frame->color_trc = codec->color_trc;
        frame->colorspace = codec->colorspace;
        frame->color_range = codec->color_range;
        frame->chroma_location = codec->chroma_sample_location;
        check(av_frame_get_buffer(frame.get(), 0), "reserve memory");

        scaler.reset(sws_getContext(video.width, video.height, AV_PIX_FMT_BGR0, video.width, video.height,
                                    codec->pix_fmt, SWS_BILINEAR | SWS_ACCURATE_RND, nullptr, nullptr,
                                    nullptr));
        if (!scaler) fail("cannot convert the colours");
        // Left alone, swscale uses BT.601, and a player that believes the tags shows other colours.
        const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
        const int full = 1, limited = 0, plain = 1 << 16;
        if (sws_setColorspaceDetails(scaler.get(), bt709, full, bt709, limited, 0, plain, plain) < 0)
            fail("cannot convert the colours to BT.709");
        packet.reset(av_packet_alloc());
    }

    void add(const std::uint8_t* bgra, int stride) {
        // The encoder may still hold the last frame's memory.
        check(av_frame_make_writable(frame.get()), "reserve memory");
        const std::uint8_t* from[] = {bgra};
        const int from_stride[] = {stride};
        sws_scale(scaler.get(), from, from_stride, 0, video.height, frame->data, frame->linesize);
        frame->pts = frames++;
        check(avcodec_send_frame(codec.get(), frame.get()), "encode");
        write_packets();
    }

    void write_packets() {
        for (;;) {
            const int error = avcodec_receive_packet(codec.get(), packet.get());
            if (error == AVERROR(EAGAIN) || error == AVERROR_EOF) return;
            check(error, "encode");
            packet->duration = 1;  // x264 leaves it out, and the rate would have to be guessed
            av_packet_rescale_ts(packet.get(), codec->time_base, output->streams[0]->time_base);
            check(av_interleaved_write_frame(output.get(), packet.get()), "write");
        }
    }

    void finish() {
        if (frames == 0) fail("cannot make a film of no frames");
        check(avcodec_send_frame(codec.get(), nullptr), "encode");
        write_packets();
        check(av_write_trailer(output.get()), "write");
        close_film(output, file);
        finish_film(part, file, video.fps);
    }

    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
    }
    void check(int error, const char* operation) const { check_film(error, file, operation); }

    std::filesystem::path file, part;
    Video video;
    std::int64_t frames = 0;
    std::unique_ptr<AVCodecContext, FreeCodec> codec;
    std::unique_ptr<AVFrame, FreeFrame> frame;
    std::unique_ptr<SwsContext, FreeScaler> scaler;
    PacketPtr packet;
    OutputPtr output;
};

Encoder::Encoder(std::filesystem::path file, const Video& video)
    : impl_(std::make_unique<Impl>(std::move(file), video)) {}
Encoder::~Encoder() = default;

void Encoder::add(const std::uint8_t* bgra, int stride) { impl_->add(bgra, stride); }
void Encoder::finish() { impl_->finish(); }

std::string encoder_name() { return x264() ? fmt::format("libx264, FFmpeg {}", av_version_info()) : ""; }

}  // namespace hibi
