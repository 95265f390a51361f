#pragma once
#include "film/encoder.hpp"
#include "film/stream.hpp"

extern "C" {
#include <libavfilter/avfilter.h>
}

namespace hibi {

struct FreeGraph {
    void operator()(AVFilterGraph* p) const { avfilter_graph_free(&p); }
};
using GraphPtr = std::unique_ptr<AVFilterGraph, FreeGraph>;

/// One palette for all pictures, so that no colour flickers: the pictures wait, packed, until it is known.
/// Then come as many attempts as the limit of the size asks for: narrower ones, and fewer frames.
class GifEncoder : public Encoder {
 public:
    GifEncoder(std::filesystem::path file, const Video& video);
    void add(const Image& image) override;
    void finish() override;

 private:
    int height_of(int width) const;
    FramePtr unpacked(std::size_t k) const;
    /// Of the pictures kept, every `every`-th.
    void write(int width, int every);

    std::filesystem::path file_, part_;
    Video video_;
    FilmStream errors_;  // says what fails; nothing is written by it
    int step_ = 1;       // of the film's frames, every step-th is kept
    int width_ = 0;      // at which they are kept
    int seen_ = 0;
    ScalerPtr scaler_;
    std::vector<std::vector<std::uint8_t>> packed_;
    GraphPtr palette_graph_;
    FramePtr palette_;
};

}  // namespace hibi
