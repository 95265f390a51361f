#include "picture_tests/compared_files.hpp"

#include <fmt/format.h>

#include "image/png.hpp"
#include "record/run_folder.hpp"

namespace hibi {

namespace fs = std::filesystem;

void refuse_to_compare(const std::string& what) { throw std::invalid_argument(what); }

const char* to_string(ComparedKind kind) {
    return kind == ComparedKind::picture  ? "a picture"
           : kind == ComparedKind::frames ? "a film's frames"
                                          : "a run";
}

ComparedKind kind_of(const fs::path& path) {
    if (!fs::exists(path)) refuse_to_compare(path.string() + ": there is no such file or folder");
    if (fs::is_directory(path))
        return fs::exists(path / "states" / "topology.hdf") ? ComparedKind::run : ComparedKind::frames;
    if (path.extension() == ".png") return ComparedKind::picture;
    if (path.extension() == ".json") return ComparedKind::frames;
    refuse_to_compare(fmt::format(
        "{}: cannot be compared; name a PNG picture, a folder of them, the frames.json of a film, "
        "or the folder of a run",
        path.string()));
}

namespace {

Frames listed_frames(const fs::path& folder) {
    Frames frames;
    for (const FrameInfo& frame :
         read_as_input("draw the film again with hibi render", [&] { return read_frames(folder); }))
        frames[frame.file] = folder / frame.file;
    return frames;
}

}  // namespace

Frames frames_of(const fs::path& path) {
    Frames frames;
    if (path.extension() == ".json") {
        if (path.filename() != "frames.json")
            refuse_to_compare(path.string() + ": not the list of a film's frames; it is called frames.json");
        frames = listed_frames(path.has_parent_path() ? path.parent_path() : fs::path("."));
    } else if (fs::exists(path / "frames.json")) {
        frames = listed_frames(path);
    } else {
        for (const auto& entry : fs::directory_iterator(path))
            if (entry.path().extension() == ".png") frames[entry.path().filename().string()] = entry.path();
    }
    if (frames.empty())
        refuse_to_compare(path.string() +
                          ": holds no PNG picture, frames.json or recorded run; nothing to compare");
    for (const auto& [name, file] : frames)
        if (!fs::exists(file))
            refuse_to_compare(
                fmt::format("{}: is missing, though frames.json lists it; draw the film again: hibi render",
                            file.string()));
    return frames;
}

Image picture_to_compare(const fs::path& file) {
    return read_as_input("compare whole PNG pictures", [&] {
        if (const int depth = png_bit_depth(file); depth > 8)
            refuse_to_compare(fmt::format("{}: has {} bits per channel, and 8 are compared; convert it first",
                                          file.string(), depth));
        return read_png(file);
    });
}

}  // namespace hibi
