#include "picture_tests/compared_files.hpp"

#include <fmt/format.h>

#include "record/run_folder.hpp"

namespace hibi {

namespace fs = std::filesystem;

const char* to_string(ComparedKind kind) {
    return kind == ComparedKind::picture  ? "a picture"
           : kind == ComparedKind::frames ? "a film's frames"
                                          : "a run";
}

ComparedKind kind_of(const fs::path& path) {
    if (!fs::exists(path)) refuse_to_compare(path.string() + ": there is no such file or folder");
    if (fs::is_directory(path))
        return fs::exists(path / "states" / "topology.hdf") ? ComparedKind::run : ComparedKind::frames;
    if (is_picture(path)) return ComparedKind::picture;
    if (path.extension() == ".json") return ComparedKind::frames;
    refuse_to_compare(
        fmt::format("{}: cannot be compared; name a picture or a film (PNG, JPEG, GIF, MP4, WebM; not "
                    "animated WebP), a folder of them, the frames.json of a film, or the folder of a run",
                    path.string()));
}

NamedFiles listed_frames(const fs::path& folder) {
    NamedFiles frames;
    for (const FrameInfo& frame :
         read_as_input("draw the film again with hibi render", [&] { return read_frames(folder); })) {
        frames[frame.file] = folder / frame.file;
        if (!fs::exists(folder / frame.file))
            refuse_to_compare(
                fmt::format("{}: is missing, though frames.json lists it; draw the film again: hibi render",
                            (folder / frame.file).string()));
    }
    return frames;
}

FolderFiles files_to_compare(const fs::path& path, const fs::path& output) {
    FolderFiles files;
    if (path.extension() == ".json") {
        if (path.filename() != "frames.json")
            refuse_to_compare(path.string() + ": not the list of a film's frames; it is called frames.json");
        files.pictures = listed_frames(path.has_parent_path() ? path.parent_path() : fs::path("."));
    } else {
        files = read_as_input("compare folders that can be read", [&] { return files_of(path, output); });
        if (fs::exists(path / "frames.json")) files.pictures.merge(listed_frames(path));
    }
    if (files.pictures.empty())
        refuse_to_compare(path.string() +
                          ": holds no picture, film, frames.json or recorded run; nothing to compare");
    return files;
}

}  // namespace hibi
