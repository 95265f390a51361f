#pragma once
#include <filesystem>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "film/reader.hpp"

namespace hibi {

/// A mistake in what is to be compared.
[[noreturn]] void refuse_to_compare(const std::string& what);

/// What reading a file complains of is the user's matter here: the file is the input. Throws
/// std::invalid_argument with a way out for what `read` throws.
template <class Read>
auto read_as_input(const char* way_out, Read&& read) {
    try {
        return read();
    } catch (const std::runtime_error& error) {
        refuse_to_compare(std::string(error.what()) + "; " + way_out);
    }
}

/// Names, relative to the folder they were found in -> their files.
using NamedFiles = std::map<std::string, std::filesystem::path>;

/// What a folder and its subfolders hold.
struct FolderFiles {
    NamedFiles pictures;  ///< and films
    NamedFiles others;    ///< whose pixels cannot be compared
};
/// Links are followed. The folder `left_out` is not looked into, wherever it lies.
FolderFiles files_of(const std::filesystem::path& folder, const std::filesystem::path& left_out);

/// ".png" of "A.PNG": what kind of file a name stands for does not depend on capital letters.
std::string lower_case_extension(const std::filesystem::path& file);

/// Can the pixels of a file with this name and content be compared?
bool is_picture(const std::filesystem::path& file);

/// Names of files that only one of both holds, or whose bytes differ.
std::vector<std::string> differing_files(const NamedFiles& expected, const NamedFiles& actual);

/// The pictures of a file one after another: one, or the frames of an animation or a film. All functions
/// throw std::invalid_argument naming the file, what is wrong with it and a way out.
class PictureSequence {
 public:
    explicit PictureSequence(std::filesystem::path file);
    std::optional<FilmFrame> next();

 private:
    std::filesystem::path file_;
    /// The PNG that has been read, nothing after it has been taken, or the film that is being read.
    std::variant<std::monostate, Image, FilmReader> source_;
};

/// The picture of that number, from 0, of a file.
Image picture_to_compare(const std::filesystem::path& file, int number = 0);

}  // namespace hibi
