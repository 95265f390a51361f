#pragma once
#include <map>
#include <string>

#include "film/remux.hpp"

extern "C" {
#include <libswscale/swscale.h>
}

namespace hibi {

struct FreeCodec {
    void operator()(AVCodecContext* p) const { avcodec_free_context(&p); }
};
struct FreeFrame {
    void operator()(AVFrame* p) const { av_frame_free(&p); }
};
struct FreeScaler {
    void operator()(SwsContext* p) const { sws_freeContext(p); }
};
using CodecPtr = std::unique_ptr<AVCodecContext, FreeCodec>;
using FramePtr = std::unique_ptr<AVFrame, FreeFrame>;
using ScalerPtr = std::unique_ptr<SwsContext, FreeScaler>;

/// Settings of encoders and files, as FFmpeg names them.
using Settings = std::map<std::string, std::string>;

/// A film of one video: what goes through the codec goes into the file. Errors name `shown`.
class FilmStream {
 public:
    FilmStream(std::filesystem::path part, std::filesystem::path shown)
        : part_(std::move(part)), shown_(std::move(shown)) {}

    /// The codec, with what holds for all: size, format, rate. To be adjusted before begin().
    AVCodecContext& codec(const char* name, int width, int height, AVPixelFormat format, AVRational rate);
    /// Opens codec and file.
    void begin(const char* muxer, const Settings& encoder, const Settings& file,
               const std::map<std::string, std::string>& metadata);
    /// nullptr: no more frames will come.
    void send(const AVFrame* frame);
    /// Writes the rest and closes the file.
    void finish();

    [[noreturn]] void fail(const std::string& what) const;
    void check(int error, const std::string& operation) const { check_film(error, shown_, operation); }

 private:
    std::filesystem::path part_, shown_;
    CodecPtr codec_;
    PacketPtr packet_;
    OutputPtr output_;
};

/// A frame with memory of its own.
FramePtr make_frame(int width, int height, AVPixelFormat format);

}  // namespace hibi
