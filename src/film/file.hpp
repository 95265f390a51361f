#pragma once
#include <filesystem>
#include <memory>
#include <string>

extern "C" {
#include <libavformat/avformat.h>
}

namespace hibi {

/// The name under which FFmpeg opens this very file. FFmpeg takes a name for a URL: without "file:" in front,
/// "12:30/movie.mp4" asks for the protocol "12". Every path that goes to FFmpeg goes through here.
std::string film_url(const std::filesystem::path& file);

/// Closes the file too.
struct CloseInput {
    void operator()(AVFormatContext* input) const;
};
using InputPtr = std::unique_ptr<AVFormatContext, CloseInput>;

/// Opens a film or a picture to be read. Its content decides which format it has, never its name: FFmpeg
/// takes names such as "movie%d.gif" for a series of pictures. Returns FFmpeg's error, or 0.
int open_film(const std::filesystem::path& file, InputPtr& input);

}  // namespace hibi
