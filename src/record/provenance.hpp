#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "record/run_folder.hpp"

namespace hibi {

/// Where a picture, film, table or page is from: enough to make it again.
struct Provenance {
    std::string title;       ///< of the scene
    std::string version;     ///< of the program
    std::string scene_hash;  ///< empty where several scenes are concerned
    std::string parameters;  ///< what -p said, "spacing=0.5m, ..."; may be empty
    std::string command;     ///< ready for a shell
};
Provenance provenance_of(const RunSummary& summary);
/// The same for what another command makes of it afterwards; without words it stays as it is.
Provenance followed_by(Provenance provenance, const std::vector<std::string>& words);

using Texts = std::map<std::string, std::string>;  ///< keyword -> text, as in a PNG
/// Keywords Title, Software, Scene hash, Parameters, Command; empty ones are left out.
Texts to_texts(const Provenance& provenance);
/// Nothing where there is no command.
std::optional<Provenance> from_texts(const Texts& texts);

/// The same in one line, for files that have room for a comment only, and back from any text that contains
/// it.
std::string to_comment(const Provenance& provenance);
std::optional<Provenance> from_comment(const std::string& text);
/// The line as a comment of HTML or Markdown; empty where there is no command.
std::string to_html_comment(const Provenance& provenance);

/// The same as a JSON object in a file of its own.
void write_texts(const std::filesystem::path& file, const Texts& texts);

/// The words of a command as a POSIX shell takes them, quoted where need be.
std::string shell_command(const std::vector<std::string>& words);
/// A path as a word of a command: one that begins with "-" would be taken for an option.
std::string path_word(const std::filesystem::path& path);
std::vector<std::string> shell_words(const std::string& command);  ///< the inverse

}  // namespace hibi
