#include "picture_tests/picture_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

#include "image/png.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

bool is_png_name(const fs::path& file) {
    const std::string extension = lower_case_extension(file);
    return extension == ".png" || extension == ".apng";
}

/// FFmpeg writes animated WebP, but cannot read it. Byte 20 of the container tells what follows (WebP
/// container, extended format).
bool is_animated_webp(const fs::path& file) {
    std::array<char, 21> head{};
    std::ifstream(file, std::ios::binary).read(head.data(), head.size());
    return std::string(head.data() + 8, 8) == "WEBPVP8X" && (head[20] & 0x02);
}

/// `parents`: the folder itself and those above it, without links; a link back to one of them would never
/// end.
void collect(const fs::path& folder, const std::string& prefix, std::vector<fs::path> parents,
             const fs::path& left_out, FolderFiles& found) {
    const fs::path real = fs::canonical(folder);
    if (std::ranges::find(parents, real) != parents.end()) return;
    parents.push_back(real);
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = prefix + entry.path().filename().string();
        std::error_code none;
        if (!fs::is_directory(entry.path(), none))
            (is_picture(entry.path()) ? found.pictures : found.others)[name] = entry.path();
        else if (!fs::equivalent(entry.path(), left_out, none))
            collect(entry.path(), name + "/", parents, left_out, found);
    }
}

bool same_bytes(const fs::path& a, const fs::path& b) {
    std::error_code none;
    // Reading from a pipe or a device might never end.
    if (!fs::is_regular_file(a, none) || !fs::is_regular_file(b, none)) return false;
    std::ifstream left(a, std::ios::binary), right(b, std::ios::binary);
    using Bytes = std::istreambuf_iterator<char>;
    return left && right && std::equal(Bytes(left), Bytes(), Bytes(right), Bytes());
}

void refuse_deep(const fs::path& file, int bits) {
    if (bits > 8)
        refuse_to_compare(fmt::format("{}: has {} bits per channel, and 8 are compared; convert it first",
                                      file.string(), bits));
}

constexpr const char* whole_pictures = "compare whole PNG pictures";
constexpr const char* whole_films = "compare whole films and pictures";

}  // namespace

void refuse_to_compare(const std::string& what) { throw std::invalid_argument(what); }

std::string lower_case_extension(const fs::path& file) {
    std::string extension = file.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return extension;
}

bool is_picture(const fs::path& file) {
    static constexpr std::array extensions{".png", ".apng", ".jpg", ".jpeg", ".gif",  ".webp", ".bmp",
                                           ".mp4", ".m4v",  ".mov", ".mkv",  ".webm", ".avi"};
    std::error_code none;
    return std::ranges::find(extensions, lower_case_extension(file)) != extensions.end() &&
           fs::is_regular_file(file, none) && !is_animated_webp(file);
}

FolderFiles files_of(const fs::path& folder, const fs::path& left_out) {
    FolderFiles found;
    collect(folder, "", {}, left_out, found);
    return found;
}

std::vector<std::string> differing_files(const NamedFiles& expected, const NamedFiles& actual) {
    NamedFiles all = expected;
    all.insert(actual.begin(), actual.end());
    std::vector<std::string> names;
    for (const auto& [name, file] : all)
        if (!expected.contains(name) || !actual.contains(name) ||
            !same_bytes(expected.at(name), actual.at(name)))
            names.push_back(name);
    return names;
}

PictureSequence::PictureSequence(fs::path file) : file_(std::move(file)) {
    if (is_png_name(file_))
        read_as_input(whole_pictures, [&] {
            refuse_deep(file_, png_bit_depth(file_));
            if (!is_animated_png(file_)) source_ = read_png(file_);
        });
    if (source_.index() == 0)
        read_as_input(whole_films,
                      [&] { refuse_deep(file_, source_.emplace<FilmReader>(file_).bit_depth()); });
}

std::optional<FilmFrame> PictureSequence::next() {
    if (FilmReader* film = std::get_if<FilmReader>(&source_))
        return read_as_input(whole_films, [&] { return film->next(); });
    if (source_.index() == 0) return {};
    FilmFrame only{.image = std::move(std::get<Image>(source_))};
    source_ = std::monostate{};
    return only;
}

Image picture_to_compare(const fs::path& file, int number) {
    PictureSequence pictures(file);
    for (int k = 0; k < number; ++k) pictures.next();
    std::optional<FilmFrame> frame = pictures.next();
    if (!frame) refuse_to_compare(file.string() + ": holds no picture");
    return std::move(frame->image);
}

}  // namespace hibi
