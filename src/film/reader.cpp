#include "film/reader.hpp"

#include <fmt/format.h>

#include <stdexcept>

extern "C" {
#include <libavutil/pixdesc.h>
}

namespace hibi {
namespace {

/// FFmpeg's own decoders of VP8 and VP9 leave the alpha out.
const AVCodec* decoder_of(const AVStream& stream) {
    const AVCodecID id = stream.codecpar->codec_id;
    const AVDictionaryEntry* alpha = av_dict_get(stream.metadata, "alpha_mode", nullptr, 0);
    if (alpha && std::string(alpha->value) == "1") {
        if (id == AV_CODEC_ID_VP8) return avcodec_find_decoder_by_name("libvpx");
        if (id == AV_CODEC_ID_VP9) return avcodec_find_decoder_by_name("libvpx-vp9");
    }
    return avcodec_find_decoder(id);
}

const AVPixFmtDescriptor& description(int format) {
    return *av_pix_fmt_desc_get(static_cast<AVPixelFormat>(format));
}

/// A palette may hold colours that are transparent.
bool has_alpha(int format) {
    return description(format).flags & (AV_PIX_FMT_FLAG_ALPHA | AV_PIX_FMT_FLAG_PAL);
}

}  // namespace

FilmReader::FilmReader(std::filesystem::path file)
    : file_(std::move(file)), packet_(av_packet_alloc()), frame_(av_frame_alloc()) {
    av_log_set_level(AV_LOG_QUIET);  // what goes wrong is thrown
    check_film(open_film(file_, input_), file_, "open the film");
    check(avformat_find_stream_info(input_.get(), nullptr));
    const int best = av_find_best_stream(input_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
    check(best);
    stream_ = input_->streams[best];
    const AVCodec* decoder = decoder_of(*stream_);
    if (!decoder) check(AVERROR_DECODER_NOT_FOUND);
    codec_.reset(avcodec_alloc_context3(decoder));
    check(avcodec_parameters_to_context(codec_.get(), stream_->codecpar));
    codec_->err_recognition = AV_EF_EXPLODE;  // a damaged picture is an error, not a guess
    check(avcodec_open2(codec_.get(), decoder, nullptr));
    if (codec_->pix_fmt == AV_PIX_FMT_NONE) check(AVERROR_INVALIDDATA);
}

int FilmReader::bit_depth() const { return description(codec_->pix_fmt).comp[0].depth; }

std::optional<FilmFrame> FilmReader::next() {
    for (;;) {
        const int got = avcodec_receive_frame(codec_.get(), frame_.get());
        if (got >= 0) return converted();
        if (got == AVERROR_EOF) return {};
        if (got != AVERROR(EAGAIN)) check(got);
        const int read = av_read_frame(input_.get(), packet_.get());
        if (read == AVERROR_EOF) {
            check(avcodec_send_packet(codec_.get(), nullptr));
            continue;
        }
        check(read);
        const int sent =
            packet_->stream_index == stream_->index ? avcodec_send_packet(codec_.get(), packet_.get()) : 0;
        av_packet_unref(packet_.get());
        check(sent);
    }
}

FilmFrame FilmReader::converted() {
    FilmFrame shown{.image = Image(frame_->width, frame_->height)};
    Image& image = shown.image;
    image.transparent = has_alpha(frame_->format);
    const ScalerPtr scaler(sws_getContext(
        image.width, image.height, static_cast<AVPixelFormat>(frame_->format), image.width, image.height,
        AV_PIX_FMT_BGRA, SWS_POINT | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
    if (!scaler) check(AVERROR(ENOSYS));
    const AVPixFmtDescriptor& pixels = description(frame_->format);
    if (pixels.nb_components >= 3 && !(pixels.flags & AV_PIX_FMT_FLAG_RGB)) {  // Y, U, V
        const int* colours = sws_getCoefficients(frame_->colorspace);
        const int plain = 1 << 16;
        sws_setColorspaceDetails(scaler.get(), colours, frame_->color_range == AVCOL_RANGE_JPEG, colours, 1,
                                 0, plain, plain);
    }
    std::uint8_t* to[] = {image.bgra.data()};
    const int stride[] = {image.stride()};
    sws_scale(scaler.get(), frame_->data, frame_->linesize, 0, image.height, to, stride);
    if (image.transparent) to_premultiplied(image.bgra.data(), image.width * image.height);
    const std::int64_t time = frame_->best_effort_timestamp;
    if (time != AV_NOPTS_VALUE) {
        if (!first_time_) first_time_ = time;
        shown.time = static_cast<double>(time - *first_time_) * av_q2d(stream_->time_base);
    }
    return shown;
}

}  // namespace hibi
