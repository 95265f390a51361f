#include "film/gif.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "film/comment.hpp"

extern "C" {
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
}

namespace hibi {
namespace {

constexpr int widest = 960, comfortable = 480, narrowest = 160;
constexpr double fastest = 15, slowest = 5;  // frames per second

std::string source(const char* name, int width, int height) {
    return fmt::format("buffer@{}=video_size={}x{}:pix_fmt=bgra:time_base=1/100:pixel_aspect=1/1", name,
                       width, height);
}

GraphPtr graph_of(const std::string& description) {
    GraphPtr graph(avfilter_graph_alloc());
    AVFilterInOut *inputs = nullptr, *outputs = nullptr;
    int error = avfilter_graph_parse2(graph.get(), description.c_str(), &inputs, &outputs);
    avfilter_inout_free(&inputs);
    avfilter_inout_free(&outputs);
    if (error >= 0) error = avfilter_graph_config(graph.get(), nullptr);
    if (error < 0) throw std::runtime_error(fmt::format("FFmpeg cannot set up \"{}\"", description));
    return graph;
}

AVFilterContext* end_of(const GraphPtr& graph, const char* name) {
    return avfilter_graph_get_filter(graph.get(), name);
}

}  // namespace

GifEncoder::GifEncoder(std::filesystem::path file, const Video& video)
    : file_(std::move(file)),
      part_(film_part_name(file_)),
      video_(video),
      errors_(part_, file_),
      step_(static_cast<int>(std::ceil(video.fps / fastest))),
      width_(std::min(widest, video.width)) {
    av_log_set_level(AV_LOG_QUIET);  // what goes wrong is thrown, not printed between the progress lines
    if (video.width <= 0 || video.height <= 0)
        errors_.fail(
            fmt::format("a film needs a width and a height; found {} x {}", video.width, video.height));
    scaler_.reset(sws_getContext(video.width, video.height, AV_PIX_FMT_BGRA, width_, height_of(width_),
                                 AV_PIX_FMT_BGRA, SWS_AREA | SWS_ACCURATE_RND, nullptr, nullptr, nullptr));
    if (!scaler_) errors_.fail("cannot scale the pictures");
    palette_graph_ = graph_of(source("in", width_, height_of(width_)) + ",palettegen,buffersink@out");
}

int GifEncoder::height_of(int width) const {
    return std::max(1, static_cast<int>(std::lround(double(width) * video_.height / video_.width)));
}

void GifEncoder::add(const Image& image) {
    if (seen_++ % step_ != 0) return;
    // A pixel is there or not: those at the rim get the colour they have on the background.
    std::vector<std::uint8_t> pixels(image.bgra.size());
    to_straight(laid_on(image, video_.background), pixels.data());
    if (image.transparent && video_.transparent)
        for (std::size_t i = 3; i < pixels.size(); i += 4) pixels[i] = image.bgra[i];

    const FramePtr frame = make_frame(width_, height_of(width_), AV_PIX_FMT_BGRA);
    const std::uint8_t* from[] = {pixels.data()};
    const int from_stride[] = {image.stride()};
    sws_scale(scaler_.get(), from, from_stride, 0, image.height, frame->data, frame->linesize);

    const std::size_t row = std::size_t(4) * width_;
    std::vector<std::uint8_t> plain(row * frame->height);
    for (int y = 0; y < frame->height; ++y)
        std::copy_n(frame->data[0] + y * frame->linesize[0], row, plain.data() + y * row);
    uLongf size = compressBound(plain.size());
    std::vector<std::uint8_t>& packed = packed_.emplace_back(size);
    if (compress2(packed.data(), &size, plain.data(), plain.size(), 1) != Z_OK)
        errors_.fail("cannot keep the picture");
    packed.resize(size);
    packed.shrink_to_fit();

    frame->pts = static_cast<std::int64_t>(packed_.size());
    errors_.check(av_buffersrc_add_frame(end_of(palette_graph_, "buffer@in"), frame.get()),
                  "find the palette");
}

FramePtr GifEncoder::unpacked(std::size_t k) const {
    FramePtr frame = make_frame(width_, height_of(width_), AV_PIX_FMT_BGRA);
    const std::size_t row = std::size_t(4) * width_;
    std::vector<std::uint8_t> plain(row * frame->height);
    uLongf size = plain.size();
    if (uncompress(plain.data(), &size, packed_[k].data(), packed_[k].size()) != Z_OK)
        errors_.fail("cannot take out the picture");
    for (int y = 0; y < frame->height; ++y)
        std::copy_n(plain.data() + y * row, row, frame->data[0] + y * frame->linesize[0]);
    return frame;
}

void GifEncoder::write(int width, int every) {
    const int height = height_of(width);
    // No dithering: its noise would double the size, and particles are flat.
    const GraphPtr graph =
        graph_of(fmt::format("{},scale={}:{}:flags=area[picture];{}[palette];"
                             "[picture][palette]paletteuse=dither=none:alpha_threshold=48:diff_mode=rectangle,buffersink@out",
                             source("in", width_, height_of(width_)), width, height,
                             source("palette", palette_->width, palette_->height)));
    FilmStream stream(part_, file_);
    stream.codec("gif", width, height, AV_PIX_FMT_PAL8, {video_.fps, step_ * every});
    stream.begin("gif", {}, {{"loop", "0"}}, video_.metadata);
    AVFilterContext* in = end_of(graph, "buffer@in");
    AVFilterContext* palette = end_of(graph, "buffer@palette");
    stream.check(av_buffersrc_write_frame(palette, palette_.get()), "use the palette");
    stream.check(av_buffersrc_add_frame(palette, nullptr), "use the palette");
    const FramePtr drawn(av_frame_alloc());
    std::int64_t count = 0;
    const auto take = [&] {
        for (;;) {
            const int error = av_buffersink_get_frame(end_of(graph, "buffersink@out"), drawn.get());
            if (error == AVERROR(EAGAIN) || error == AVERROR_EOF) return;
            stream.check(error, "use the palette");
            drawn->pts = count++;
            stream.send(drawn.get());
            av_frame_unref(drawn.get());
        }
    };
    for (std::size_t k = 0; k < packed_.size(); k += every) {
        const FramePtr frame = unpacked(k);
        frame->pts = static_cast<std::int64_t>(k);
        stream.check(av_buffersrc_add_frame(in, frame.get()), "use the palette");
        take();
    }
    stream.check(av_buffersrc_add_frame(in, nullptr), "use the palette");
    take();
    stream.finish();
}

void GifEncoder::finish() {
    if (packed_.empty()) errors_.fail("cannot make a film of no frames");
    errors_.check(av_buffersrc_add_frame(end_of(palette_graph_, "buffer@in"), nullptr), "find the palette");
    palette_.reset(av_frame_alloc());
    errors_.check(av_buffersink_get_frame(end_of(palette_graph_, "buffersink@out"), palette_.get()),
                  "find the palette");
    palette_->pts = 0;

    for (int width = width_, every = 1;;) {
        write(width, every);
        const double size = static_cast<double>(std::filesystem::file_size(part_));
        const bool slow = video_.fps / double(step_ * every) < 2 * slowest;
        if (size <= video_.gif_limit || (slow && width <= narrowest)) break;
        const int narrower = static_cast<int>(0.95 * width * std::sqrt(video_.gif_limit / size));
        if (narrower >= comfortable || slow)
            width = std::clamp(narrower, std::min(narrowest, width), width);
        else
            every *= 2;
    }
    if (video_.metadata.contains("comment")) write_film_comment(part_, video_.metadata.at("comment"));
    rename_film(part_, file_);
}

}  // namespace hibi
