#include "record/provenance.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "record/files.hpp"

namespace hibi {

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* program = "hibi ";
constexpr const char* comment_mark = "hibi: {";

}  // namespace

Provenance provenance_of(const RunSummary& summary) {
    std::string parameters;
    for (const auto& [name, value] : summary.parameters)
        parameters += (parameters.empty() ? "" : ", ") + name + "=" + value;
    return {summary.title, summary.version, summary.scene_hash, parameters, summary.command};
}

Provenance followed_by(Provenance provenance, const std::vector<std::string>& words) {
    if (!words.empty() && !provenance.command.empty()) provenance.command += " && " + shell_command(words);
    return provenance;
}

Texts to_texts(const Provenance& p) {
    Texts texts{{"Title", p.title},
                {"Software", program + p.version},
                {"Scene hash", p.scene_hash},
                {"Parameters", p.parameters},
                {"Command", p.command}};
    std::erase_if(texts, [](const auto& entry) { return entry.second.empty(); });
    return texts;
}

std::optional<Provenance> from_texts(const Texts& texts) {
    const auto text = [&](const char* keyword) {
        const auto found = texts.find(keyword);
        return found == texts.end() ? std::string() : found->second;
    };
    std::string version = text("Software");
    if (text("Command").empty() || !version.starts_with(program)) return {};
    version.erase(0, std::string(program).size());
    return Provenance{text("Title"), version, text("Scene hash"), text("Parameters"), text("Command")};
}

std::string to_comment(const Provenance& provenance) {
    Json json = Json::object();
    for (const auto& [keyword, text] : to_texts(provenance)) json[keyword] = text;
    // Bytes that are no UTF-8 must not cost the file: they become question marks.
    return std::string(comment_mark, 6) + json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string to_html_comment(const Provenance& provenance) {
    if (provenance.command.empty()) return {};
    std::string text = to_comment(provenance);
    // No "-->" may occur in it.
    for (std::size_t at = 0; (at = text.find('>', at)) != std::string::npos;)
        text.replace(at, 1, "\\u003e");
    return "<!-- " + text + " -->\n";
}

std::optional<Provenance> from_comment(const std::string& text) {
    const std::size_t begin = text.find(comment_mark);
    if (begin == std::string::npos) return {};
    // The object ends where its braces do, whatever follows.
    int depth = 0;
    bool quoted = false;
    std::size_t end = begin + 6;
    for (; end < text.size(); ++end) {
        if (quoted && text[end] == '\\')
            ++end;
        else if (text[end] == '"')
            quoted = !quoted;
        else if (!quoted && text[end] == '{')
            ++depth;
        else if (!quoted && text[end] == '}' && --depth == 0)
            break;
    }
    const Json json = Json::parse(text.substr(begin + 6, end - begin - 5), nullptr, false);
    if (!json.is_object()) return {};
    Texts texts;
    for (const auto& [keyword, value] : json.items())
        if (value.is_string()) texts[keyword] = value.get<std::string>();
    return from_texts(texts);
}

void write_texts(const std::filesystem::path& file, const Texts& texts) {
    write_file(file, Json(texts).dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

std::string shell_command(const std::vector<std::string>& words) {
    constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
    std::string command;
    for (const std::string& word : words) {
        if (!command.empty()) command += ' ';
        if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
            command += word;
            continue;
        }
        command += '\'';
        for (const char c : word) command += c == '\'' ? "'\\''" : std::string(1, c);
        command += '\'';
    }
    return command;
}

std::string path_word(const std::filesystem::path& path) {
    return path.string().starts_with('-') ? "./" + path.string() : path.string();
}

std::vector<std::string> shell_words(const std::string& command) {
    std::vector<std::string> words;
    bool quoted = false, inside = false;
    for (std::size_t k = 0; k < command.size(); ++k) {
        const char c = command[k];
        if (!quoted && c == ' ') {
            inside = false;
            continue;
        }
        if (!inside) words.emplace_back();
        inside = true;
        if (c == '\'')
            quoted = !quoted;
        else if (!quoted && c == '\\' && k + 1 < command.size())
            words.back() += command[++k];
        else
            words.back() += c;
    }
    return words;
}

}  // namespace hibi
