#include "film/file.hpp"

namespace hibi {

std::string film_url(const std::filesystem::path& file) { return "file:" + file.string(); }

void CloseInput::operator()(AVFormatContext* input) const {
    AVIOContext* bytes = input->pb;
    avformat_close_input(&input);
    avio_closep(&bytes);
}

int open_film(const std::filesystem::path& file, InputPtr& input) {
    AVIOContext* bytes = nullptr;
    if (const int error = avio_open(&bytes, film_url(file).c_str(), AVIO_FLAG_READ); error < 0) return error;
    const AVInputFormat* format = nullptr;
    AVFormatContext* opened = avformat_alloc_context();
    int error = av_probe_input_buffer2(bytes, &format, nullptr, nullptr, 0, 0);
    opened->pb = bytes;
    // A context that cannot be opened is freed, its bytes are not.
    if (error >= 0)
        error = avformat_open_input(&opened, nullptr, format, nullptr);
    else
        avformat_free_context(opened);
    if (error < 0)
        avio_closep(&bytes);
    else
        input.reset(opened);
    return error < 0 ? error : 0;
}

}  // namespace hibi
