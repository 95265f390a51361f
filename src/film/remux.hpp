#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
}

namespace hibi {

/// Closes the file too, where one is open.
struct CloseOutput {
    void operator()(AVFormatContext* output) const;
};
struct FreePacket {
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};
using OutputPtr = std::unique_ptr<AVFormatContext, CloseOutput>;
using PacketPtr = std::unique_ptr<AVPacket, FreePacket>;

/// Throws std::runtime_error "FILE: cannot OPERATION: why" where FFmpeg's error is negative.
void check_film(int error, const std::filesystem::path& file, const std::string& operation);

/// out/movie.mp4 -> out/movie.part.mp4: a name that players open.
std::filesystem::path film_part_name(const std::filesystem::path& file);

/// Creates `path` in a format by FFmpeg's name of it; errors name `shown`.
OutputPtr create_film(const std::filesystem::path& path, const std::filesystem::path& shown,
                      const char* muxer);
AVStream* add_film_stream(AVFormatContext& output, const std::map<std::string, std::string>& metadata);
void set_film_rate(AVStream& stream, AVRational fps);

/// Closes what has been written completely; the disk's last error is found here.
void close_film(OutputPtr& output, const std::filesystem::path& shown);

void rename_film(const std::filesystem::path& from, const std::filesystem::path& to);

/// Rewrites the fragmented `part` as an ordinary MP4 with its index in front, gives it the name `file`, and
/// removes the part.
void finish_film(const std::filesystem::path& part, const std::filesystem::path& file, int fps);

}  // namespace hibi
