#include "picture_tests/update_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "image/png.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

/// Writes a new picture; an old one that differs stays beside it.
void renew_picture(const fs::path& file, const Image& image, std::vector<std::string>& updates) {
    bool same = false, there = fs::exists(file);
    if (there) {
        try {
            same = pixel_hash(read_png(file)) == pixel_hash(image);
        } catch (const std::runtime_error&) {
            // A damaged one is written over like any other.
        }
    }
    if (same) return;
    if (there) fs::rename(file, fs::path(file).replace_extension(".old.png"));
    write_png(file, image, {.small = true});
    updates.push_back((there ? "changed " : "new ") + file.string());
}

}  // namespace

void update_reference(SceneResult& r, const DrawnTest& drawn, Update what) {
    const auto lacks_reference = [](const MomentResult& m) {
        return m.complaint.starts_with("has no reference");
    };
    const auto missing = [&] { return !r.reference || std::ranges::any_of(r.moments, lacks_reference); };
    if (what == Update::changed ? r.passes() : what == Update::missing && !missing()) return;
    const fs::path folder = reference_folder(r.file);
    Reference renewed = drawn.reference;
    if (what == Update::missing && r.reference) {
        // What is there stays as it is, and is judged as before.
        renewed = *r.reference;
        for (const ReferenceFrame& frame : drawn.reference.frames) {
            const auto known = std::ranges::find(renewed.frames, frame.moment, &ReferenceFrame::moment);
            if (known == renewed.frames.end())
                renewed.frames.push_back(frame);
            else if (!fs::exists(folder / known->file))
                *known = frame;
        }
    }
    fs::create_directories(folder);
    for (std::size_t k = 0; k < drawn.images.size(); ++k) {
        const ReferenceFrame& frame = drawn.reference.frames[k];
        const bool kept = what == Update::missing && fs::exists(folder / frame.file);
        if (drawn.images[k].width > 0 && !kept)
            renew_picture(folder / frame.file, drawn.images[k], r.updates);
    }
    if (what != Update::missing)
        for (const auto& entry : fs::directory_iterator(folder)) {
            const std::string name = entry.path().filename().string();
            if (!name.ends_with(".png") || name.ends_with(".old.png")) continue;
            if (std::ranges::find(renewed.frames, name, &ReferenceFrame::file) == renewed.frames.end()) {
                fs::rename(entry.path(), fs::path(entry.path()).replace_extension(".old.png"));
                r.updates.push_back("no longer used " + entry.path().string());
            }
        }
    std::ranges::stable_sort(renewed.frames, {}, &ReferenceFrame::time);
    if (r.updates.empty() && !r.physics.empty()) r.updates.push_back("numbers: " + r.physics);
    write_reference(folder, renewed);
    r.updates.push_back("wrote " + (folder / "references.json").string());
    r.complaint.clear();
    if (what == Update::missing) {
        std::erase_if(r.moments, lacks_reference);
        return;
    }
    r.physics.clear();
    r.moments.clear();
}

}  // namespace hibi
