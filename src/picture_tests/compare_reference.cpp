#include "picture_tests/compare_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "picture_tests/frame_difference.hpp"
#include "record/files.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

void compare_moment(const SceneResult& r, const DrawnTest& drawn, const ReferenceFrame& frame,
                    MomentResult& m, const fs::path& output) {
    const auto& frames = r.reference->frames;
    const auto expected = std::ranges::find(frames, frame.moment, &ReferenceFrame::moment);
    if (expected == frames.end()) {
        m.complaint = "has no reference";
        return;
    }
    // The file decides, not the list: a damaged one must not pass.
    const fs::path file = reference_folder(r.file) / expected->file;
    if (!fs::exists(file)) {
        m.complaint = "has no reference: " + file.string() + " is missing";
        return;
    }
    m.sameness = Sameness::different;
    Image picture;
    try {
        picture = picture_to_compare(file);
    } catch (const std::invalid_argument& error) {
        m.complaint = error.what();
        return;
    }
    if (pixel_hash(picture) != expected->sha256) {
        m.complaint = file.string() + " is not the picture that references.json names";
        return;
    }
    const Image& actual = drawn.image_of(frame.file);
    try {
        m.pixels = difference(picture, actual);
    } catch (const std::invalid_argument& error) {
        m.complaint = error.what();
        return;
    }
    m.sameness = judge(m.pixels, r.pixels);
    if (m.sameness == Sameness::identical) return;
    if (r.exact && m.sameness == Sameness::tolerated)
        m.complaint = fmt::format("not identical (worst tile {:.2g}), on the renderer of the references",
                                  m.pixels.tile);
    else if (m.sameness == Sameness::different)
        m.complaint = beyond(m.pixels, r.pixels);
    if (m.complaint.empty()) return;
    const fs::path folder = output / r.name / frame.moment;
    fs::create_directories(folder);
    write_difference_pictures(folder, picture, actual, m.pixels);
    DifferencePage page{.title = fmt::format("{}: {}", r.name, frame.moment),
                        .verdict = (r.physics.empty() ? "drawing changed, physics the same" : r.physics) +
                                   " (" + m.complaint + ")",
                        .differs = true,
                        .expected_name = file.string(),
                        .actual_name = "now",
                        .pictures = page_pictures("", picture, actual, m.pixels),
                        .tables = {pixel_table(m.pixels, r.pixels)}};
    page.tables.push_back({"Renderer and processor",
                           "",
                           {{"references", r.reference->key.renderer + ", " + r.reference->key.cpu, "", {}},
                            {"now", drawn.reference.key.renderer + ", " + drawn.reference.key.cpu, "", {}}}});
    m.page = folder / "difference.html";
    write_file(m.page, difference_page(page));
}

}  // namespace

void compare_with_reference(SceneResult& r, const DrawnTest& drawn, const fs::path& output) {
    if (!r.reference) {
        r.complaint = "has no references";
        return;
    }
    r.exact = r.reference->key == drawn.reference.key;
    r.physics = physics_change(*r.reference, drawn.reference, r.run);
    for (const ReferenceFrame& frame : drawn.reference.frames) {
        MomentResult m{.moment = frame.moment};
        compare_moment(r, drawn, frame, m, output);
        r.moments.push_back(std::move(m));
    }
    for (const ReferenceFrame& frame : r.reference->frames)
        if (std::ranges::find(drawn.reference.frames, frame.moment, &ReferenceFrame::moment) ==
            drawn.reference.frames.end())
            r.moments.push_back(
                {.moment = frame.moment,
                 .sameness = Sameness::different,
                 .complaint = "has a reference, but did not happen or is not in [test] frames"});
}

}  // namespace hibi
