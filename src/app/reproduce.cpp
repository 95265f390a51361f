#include "app/reproduce.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

#include "film/metadata.hpp"
#include "image/png.hpp"
#include "picture_tests/picture_files.hpp"
#include "record/provenance.hpp"
#include "record/summary.hpp"
#include "scene/read.hpp"
#include "scene/scene_file.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

/// Tables and pages say it in their first lines.
std::string beginning_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::string text(65536, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    return text;
}

/// Animated WebP ends with an XMP packet; < and & are escaped in it, as in the metadata of an SVG.
std::string end_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    in.seekg(-std::min<std::streamoff>(65536, static_cast<std::streamoff>(fs::file_size(file))),
             std::ios::end);
    return {std::istreambuf_iterator<char>(in), {}};
}

std::optional<Provenance> from_xml(std::string text) {
    for (const auto& [code, character] : {std::pair("&lt;", "<"), std::pair("&amp;", "&")})
        for (std::size_t at = 0; (at = text.find(code, at)) != std::string::npos; ++at)
            text.replace(at, std::strlen(code), character);
    return from_comment(text);
}

std::optional<Provenance> read_provenance(const fs::path& file) {
    if (!fs::exists(file)) throw std::runtime_error(fmt::format("{}: there is no such file", file.string()));
    if (fs::is_directory(file) || file.filename() == "run.json") {
        const fs::path folder = fs::is_directory(file) ? file : file.parent_path();
        if (!fs::exists(folder / "run.json")) return {};
        const Provenance provenance = provenance_of(read_summary(folder));
        return provenance.command.empty() ? std::nullopt : std::optional(provenance);
    }
    const std::string type = lower_case_extension(file);
    if (type == ".png") {
        PngText text;
        read_png(file, &text);
        return from_texts(text);
    }
    if (type == ".svg") return from_xml(beginning_of(file));
    if (const auto found = from_comment(beginning_of(file))) return found;
    if (type == ".webp")
        if (const auto found = from_xml(end_of(file))) return found;
    for (const auto& [key, text] : film_metadata(file))
        if (const auto found = from_comment(text)) return found;
    return {};
}

/// Looks at the scene of `hibi run SCENE -p ... -o ...`, or of `cat SCENE | hibi run /dev/stdin -o ...`, as
/// the shell words of the command stand there.
void note_changes(const Provenance& provenance) {
    const auto note = [](const std::string& text) { fmt::print(stderr, "hibi reproduce: note: {}\n", text); };
    if (provenance.version != HIBI_VERSION)
        note(fmt::format("made by hibi {}; this is hibi " HIBI_VERSION, provenance.version));
    const std::vector<std::string> words = shell_words(provenance.command);
    if (words.size() < 3) return;
    const bool piped = words[0] == "cat";
    if (!piped)
        for (const std::string& word : words)
            if (is_stream(word)) return note(fmt::format("{} was a pipe, and what it held is gone", word));
    if (!piped && words[1] != "run") return;
    const fs::path file = piped ? words[1] : words[2];
    if (!fs::exists(file)) {
        note(fmt::format("{} is not here: go to the folder it was run from", file.string()));
        return;
    }
    Overrides overrides;
    for (std::size_t k = 3; k + 1 < words.size(); ++k)
        if (words[k] == "-p") {
            const std::size_t equals = words[k + 1].find('=');
            overrides.push_back({words[k + 1].substr(0, equals), words[k + 1].substr(equals + 1)});
        }
    std::string now = "cannot be read any more";
    try {
        if (scene_hash(read_scene(file, overrides)) == provenance.scene_hash) return;
        now = "is another scene by now";
    } catch (const SceneErrors&) {
    }
    note(
        fmt::format("{} {}; scene.toml in the folder of the run is the scene as it was", file.string(), now));
}

}  // namespace

int reproduce_command(const ReproduceOptions& options) {
    const std::optional<Provenance> provenance = read_provenance(options.file);
    if (!provenance) {
        fmt::print(
            stderr,
            "hibi reproduce: error: {} does not say how it was made; expected a picture, film, table or "
            "page made by hibi, or the folder of a run\n",
            options.file.string());
        return 2;
    }
    if (options.json) {
        nlohmann::ordered_json json{{"title", provenance->title},
                                    {"version", provenance->version},
                                    {"scene_hash", provenance->scene_hash},
                                    {"parameters", provenance->parameters},
                                    {"command", provenance->command}};
        fmt::print("{}\n", json.dump(2));
    } else {
        fmt::print("{}\n", provenance->command);
        std::fflush(stdout);
    }
    note_changes(*provenance);
    return 0;
}

}  // namespace hibi
