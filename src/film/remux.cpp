#include "film/remux.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <system_error>

#include "film/file.hpp"

namespace hibi {

void CloseOutput::operator()(AVFormatContext* output) const {
    avio_closep(&output->pb);
    avformat_free_context(output);
}

void check_film(int error, const std::filesystem::path& file, const std::string& operation) {
    if (error >= 0) return;
    char reason[AV_ERROR_MAX_STRING_SIZE] = "";
    av_strerror(error, reason, sizeof reason);
    throw std::runtime_error(fmt::format("{}: cannot {}: {}", file.string(), operation, reason));
}

std::filesystem::path film_part_name(const std::filesystem::path& file) {
    return file.parent_path() / fmt::format("{}.part{}", file.stem().string(), file.extension().string());
}

OutputPtr create_film(const std::filesystem::path& path, const std::filesystem::path& shown,
                      const char* muxer) {
    // The muxer may open the file once more by this name, to move its index to the front.
    const std::string url = film_url(path);
    AVFormatContext* output = nullptr;
    check_film(avformat_alloc_output_context2(&output, nullptr, muxer, url.c_str()), shown,
               fmt::format("use the format \"{}\"", muxer));
    OutputPtr owner(output);
    check_film(avio_open(&output->pb, url.c_str(), AVIO_FLAG_WRITE), shown, "create the file");
    return owner;
}

AVStream* add_film_stream(AVFormatContext& output, const std::map<std::string, std::string>& metadata) {
    for (const auto& [key, value] : metadata) av_dict_set(&output.metadata, key.c_str(), value.c_str(), 0);
    AVStream* stream = avformat_new_stream(&output, nullptr);
    if (!stream) throw std::bad_alloc();
    return stream;
}

void set_film_rate(AVStream& stream, AVRational fps) {
    stream.time_base = av_inv_q(fps);
    stream.avg_frame_rate = stream.r_frame_rate = fps;
}

void close_film(OutputPtr& output, const std::filesystem::path& shown) {
    check_film(avio_closep(&output->pb), shown, "write");
    output.reset();
}

void rename_film(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code failed;
    std::filesystem::rename(from, to, failed);
    if (failed)
        throw std::runtime_error(
            fmt::format("{}: cannot rename the film: {}", to.string(), failed.message()));
}

void finish_film(const std::filesystem::path& part, const std::filesystem::path& file, int fps) {
    const std::filesystem::path whole =
        file.parent_path() / fmt::format("{}.whole.mp4", file.stem().string());
    {
        InputPtr input;
        check_film(open_film(part, input), part, "read back the film");
        check_film(avformat_find_stream_info(input.get(), nullptr), part, "read back the film");
        OutputPtr output = create_film(whole, file, "mp4");
        av_dict_copy(&output->metadata, input->metadata, 0);
        AVStream* stream = add_film_stream(*output, {});
        check_film(avcodec_parameters_copy(stream->codecpar, input->streams[0]->codecpar), file,
                   "copy the film");
        set_film_rate(*stream, {fps, 1});
        AVDictionary* options = nullptr;
        av_dict_set(&options, "movflags", "faststart", 0);
        const int error = avformat_write_header(output.get(), &options);
        av_dict_free(&options);
        check_film(error, file, "begin the film");
        const PacketPtr packet(av_packet_alloc());
        for (;;) {
            const int read = av_read_frame(input.get(), packet.get());
            if (read == AVERROR_EOF) break;
            check_film(read, part, "read back the film");
            av_packet_rescale_ts(packet.get(), input->streams[0]->time_base, stream->time_base);
            check_film(av_interleaved_write_frame(output.get(), packet.get()), file, "write");
        }
        check_film(av_write_trailer(output.get()), file, "write");
        close_film(output, file);
    }
    rename_film(whole, file);
    std::error_code failed;
    std::filesystem::remove(part, failed);
}

}  // namespace hibi
