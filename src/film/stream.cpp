#include "film/stream.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace hibi {
namespace {

struct Dictionary {
    explicit Dictionary(const Settings& settings) {
        for (const auto& [key, value] : settings) av_dict_set(&entries, key.c_str(), value.c_str(), 0);
    }
    ~Dictionary() { av_dict_free(&entries); }
    Dictionary(const Dictionary&) = delete;
    Dictionary& operator=(const Dictionary&) = delete;
    AVDictionary* entries = nullptr;
};

}  // namespace

AVCodecContext& FilmStream::codec(const char* name, int width, int height, AVPixelFormat format,
                                  AVRational rate) {
    av_log_set_level(AV_LOG_QUIET);  // what goes wrong is thrown, not printed between the progress lines
    const AVCodec* encoder = avcodec_find_encoder_by_name(name);
    if (!encoder) fail(fmt::format("cannot open encoder \"{}\": not in this build of FFmpeg", name));
    codec_.reset(avcodec_alloc_context3(encoder));
    codec_->width = width;
    codec_->height = height;
    codec_->pix_fmt = format;
    codec_->time_base = av_inv_q(rate);
    codec_->framerate = rate;
    codec_->sample_aspect_ratio = {1, 1};
    return *codec_;
}

void FilmStream::begin(const char* muxer, const Settings& encoder, const Settings& file,
                       const std::map<std::string, std::string>& metadata) {
    output_ = create_film(part_, shown_, muxer);
    output_->flags |= AVFMT_FLAG_FLUSH_PACKETS;  // what is complete stands on the disk
    if (output_->oformat->flags & AVFMT_GLOBALHEADER) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    Dictionary of_encoder(encoder), of_file(file);
    check(avcodec_open2(codec_.get(), codec_->codec, &of_encoder.entries),
          fmt::format("open encoder \"{}\"", codec_->codec->name));
    AVStream* stream = add_film_stream(*output_, metadata);
    check(avcodec_parameters_from_context(stream->codecpar, codec_.get()), "describe the video");
    set_film_rate(*stream, codec_->framerate);
    if (codec_->pix_fmt == AV_PIX_FMT_YUVA420P) av_dict_set(&stream->metadata, "alpha_mode", "1", 0);
    check(avformat_write_header(output_.get(), &of_file.entries), "begin the film");
    packet_.reset(av_packet_alloc());
}

void FilmStream::send(const AVFrame* frame) {
    check(avcodec_send_frame(codec_.get(), frame), "encode");
    for (;;) {
        const int error = avcodec_receive_packet(codec_.get(), packet_.get());
        if (error == AVERROR(EAGAIN) || error == AVERROR_EOF) return;
        check(error, "encode");
        if (packet_->duration == 0)
            packet_->duration = 1;  // x264 leaves it out; the rate would have to be guessed
        av_packet_rescale_ts(packet_.get(), codec_->time_base, output_->streams[0]->time_base);
        check(av_interleaved_write_frame(output_.get(), packet_.get()), "write");
    }
}

void FilmStream::finish() {
    send(nullptr);
    check(av_write_trailer(output_.get()), "write");
    close_film(output_, shown_);
}

void FilmStream::fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", shown_.string(), what));
}

FramePtr make_frame(int width, int height, AVPixelFormat format) {
    FramePtr frame(av_frame_alloc());
    frame->width = width;
    frame->height = height;
    frame->format = format;
    if (av_frame_get_buffer(frame.get(), 0) < 0) throw std::bad_alloc();
    return frame;
}

}  // namespace hibi
