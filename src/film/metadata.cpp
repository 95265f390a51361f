#include "film/metadata.hpp"

extern "C" {
#include <libavformat/avformat.h>
}

namespace hibi {

std::map<std::string, std::string> film_metadata(const std::filesystem::path& file) {
    av_log_set_level(AV_LOG_QUIET);
    std::map<std::string, std::string> metadata;
    AVFormatContext* input = nullptr;
    if (avformat_open_input(&input, file.c_str(), nullptr, nullptr) < 0) return metadata;
    const auto collect = [&](const AVDictionary* dictionary) {
        const AVDictionaryEntry* entry = nullptr;
        while ((entry = av_dict_get(dictionary, "", entry, AV_DICT_IGNORE_SUFFIX)))
            metadata[entry->key] = entry->value;
    };
    collect(input->metadata);
    for (unsigned k = 0; k < input->nb_streams; ++k) collect(input->streams[k]->metadata);
    avformat_close_input(&input);
    return metadata;
}

}  // namespace hibi
