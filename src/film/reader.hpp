#pragma once
#include <optional>

#include "film/file.hpp"
#include "film/stream.hpp"
#include "image/image.hpp"

namespace hibi {

/// One picture of a film.
struct FilmFrame {
    Image image;
    double time = 0;  ///< at which it is shown, after the first one (s)
};

/// Decodes a film, or a picture of any format that FFmpeg knows, frame by frame, alpha included. Every
/// function throws std::runtime_error naming the file and what is wrong with it.
class FilmReader {
 public:
    explicit FilmReader(std::filesystem::path file);

    /// The next picture; nothing after the last one.
    std::optional<FilmFrame> next();
    /// Bits per channel, as the file says.
    int bit_depth() const;

 private:
    void check(int error) const { check_film(error, file_, "decode the film"); }
    FilmFrame converted();

    std::filesystem::path file_;
    InputPtr input_;
    CodecPtr codec_;
    PacketPtr packet_;
    FramePtr frame_;
    const AVStream* stream_ = nullptr;
    std::optional<std::int64_t> first_time_{};
};

}  // namespace hibi
