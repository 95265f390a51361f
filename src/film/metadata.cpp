#include "film/metadata.hpp"

#include "film/file.hpp"

namespace hibi {

std::map<std::string, std::string> film_metadata(const std::filesystem::path& file) {
    av_log_set_level(AV_LOG_QUIET);
    std::map<std::string, std::string> metadata;
    InputPtr input;
    if (open_film(file, input) < 0) return metadata;
    const auto collect = [&](const AVDictionary* dictionary) {
        const AVDictionaryEntry* entry = nullptr;
        while ((entry = av_dict_get(dictionary, "", entry, AV_DICT_IGNORE_SUFFIX)))
            metadata[entry->key] = entry->value;
    };
    collect(input->metadata);
    for (unsigned k = 0; k < input->nb_streams; ++k) collect(input->streams[k]->metadata);
    return metadata;
}

}  // namespace hibi
