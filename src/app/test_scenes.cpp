#include "app/test_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <thread>

#include "app/junit.hpp"
#include "app/picture_files.hpp"
#include "app/process.hpp"
#include "app/progress.hpp"
#include "app/reference.hpp"
#include "image/png.hpp"
#include "record/files.hpp"
#include "record/provenance.hpp"
#include "scene/read.hpp"
#include "scene/scene_file.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// One moment beside its reference.
struct MomentResult {
    std::string moment;
    Sameness sameness = Sameness::identical;
    PixelDifference pixels{};
    std::string complaint{};  ///< why it fails; empty: it passes
    fs::path page{};          ///< of a failure; empty: none
};

struct SceneResult {
    fs::path file;
    std::string name;  ///< of its folders
    Overrides overrides{};
    Scene scene{};
    Tolerance pixels{};
    RunTolerance run{};
    std::optional<Reference> reference{};
    std::string error{};      ///< the run failed, and why
    std::string complaint{};  ///< why it fails beyond single moments
    std::string physics{};    ///< what changed; empty: nothing
    bool exact = false;
    std::vector<MomentResult> moments{};
    std::vector<std::string> updates{};  ///< what was written
    double seconds = 0;

    bool passes() const {
        return error.empty() && complaint.empty() && physics.empty() &&
               std::ranges::all_of(moments, [](const MomentResult& m) { return m.complaint.empty(); });
    }
    Sameness sameness() const {
        Sameness worst = Sameness::identical;
        for (const MomentResult& m : moments) worst = std::max(worst, m.sameness);
        return worst;
    }
};

std::vector<fs::path> scene_files(const std::vector<fs::path>& named) {
    std::vector<fs::path> files;
    for (const fs::path& path : named) {
        if (!fs::is_directory(path)) {
            files.push_back(path);
            continue;
        }
        std::vector<fs::path> inside;
        for (const auto& entry : fs::directory_iterator(path))
            if (entry.path().extension() == ".toml") inside.push_back(entry.path());
        if (inside.empty())
            throw std::invalid_argument(path.string() +
                                        ": holds no scene (*.toml); name scenes or a folder of them");
        std::ranges::sort(inside);
        files.insert(files.end(), inside.begin(), inside.end());
    }
    return files;
}

Overrides overrides_of(const TestSpec& test) {
    Overrides overrides;
    for (const std::string& text : test.params) {
        const std::size_t equals = text.find('=');
        overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return overrides;
}

/// Every scene and reference is read before anything is run; what is wrong with any is told at once.
std::vector<SceneResult> read_all(const TestOptions& options) {
    std::vector<SceneResult> results;
    std::string complaints;
    std::set<std::string> names;
    for (const fs::path& file : scene_files(options.scenes)) {
        SceneResult r{.file = file, .name = file.stem().string()};
        for (int k = 2; !names.insert(r.name).second; ++k)
            r.name = fmt::format("{}_{}", file.stem().string(), k);
        try {
            require_file(file);
            r.overrides = overrides_of(read_scene(file).test);
            r.scene = read_scene(file, r.overrides);
            for (const TestLimits& limits : {r.scene.test.tolerance, options.limits})
                set_limits(limits, r.pixels, r.run);
            if (options.update != Update::all) r.reference = read_reference(reference_folder(file));
        } catch (const std::exception& error) {
            complaints += fmt::format("{}{}", complaints.empty() ? "" : "\n", error.what());
        }
        results.push_back(std::move(r));
    }
    if (!complaints.empty()) throw std::invalid_argument(complaints);
    return results;
}

/// Runs a scene in a process of its own, so that it can fail alone.
void run_scene(SceneResult& r, const fs::path& folder, int threads) {
    std::vector<std::string> words{this_program().string(),
                                   "run",
                                   path_word(r.file),
                                   "-o",
                                   path_word(folder),
                                   "--no-pictures",
                                   "--force",
                                   "-q",
                                   "--threads",
                                   std::to_string(threads)};
    for (const auto& [name, value] : r.overrides) words.insert(words.end(), {"-p", name + "=" + value});
    const ProcessEnd end = run_process(words);
    if (end.status == 0) return;
    r.error = end.status > 128  ? fmt::format("the run was ended by signal {}", end.status - 128)
              : end.status == 4 ? "the energy balance of the run is off by more than 2 %"
                                : end.error_output.substr(0, end.error_output.find_last_not_of('\n') + 1);
}

void compare_moment(const SceneResult& r, const DrawnTest& drawn, const ReferenceFrame& frame,
                    MomentResult& m, const TestOptions& options) {
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
    const fs::path folder = options.output / r.name / frame.moment;
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

void compare(SceneResult& r, const DrawnTest& drawn, const TestOptions& options) {
    if (!r.reference) {
        r.complaint = "has no references";
        return;
    }
    r.exact = r.reference->key == drawn.reference.key;
    r.physics = physics_change(*r.reference, drawn.reference, r.run);
    for (const ReferenceFrame& frame : drawn.reference.frames) {
        MomentResult m{.moment = frame.moment};
        compare_moment(r, drawn, frame, m, options);
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

void update(SceneResult& r, const DrawnTest& drawn, Update what) {
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

std::string line_of(const SceneResult& r) {
    std::string text = fmt::format("{:<4} {:<24} ", r.passes() ? "ok" : "FAIL", r.name);
    if (!r.error.empty()) return text + r.error;
    std::string updates;
    for (const std::string& update : r.updates) updates += "\n       " + update;
    if (r.passes() && !updates.empty()) return text + "updated" + updates;
    if (!r.complaint.empty())
        return text + fmt::format(
                          "{}; look at the pictures that hibi test --update missing {} writes, and commit "
                          "them",
                          r.complaint, r.file.string());
    const char* how =
        r.exact ? "exact" : "tolerant, since the references are from another renderer or processor";
    if (r.passes())
        return text + fmt::format("{} pictures {} ({}; {:.1f} s)", r.moments.size(), to_string(r.sameness()),
                                  how, r.seconds);
    text += r.physics.empty() ? "drawing changed, physics the same" : r.physics;
    text += fmt::format(" ({})", how);
    for (const MomentResult& m : r.moments) {
        if (m.complaint.empty()) continue;
        text += fmt::format("\n       {}: {}", m.moment, m.complaint);
        if (!m.page.empty()) text += "\n         " + m.page.string();
    }
    return text + updates;
}

std::string to_json(const std::vector<SceneResult>& results) {
    Json list = Json::array();
    for (const SceneResult& r : results) {
        Json moments = Json::array();
        for (const MomentResult& m : r.moments)
            moments.push_back({{"moment", m.moment},
                               {"sameness", to_string(m.sameness)},
                               {"complaint", m.complaint},
                               {"tile", m.pixels.tile},
                               {"pixels", m.pixels.pixels},
                               {"mean", m.pixels.mean},
                               {"rmse", m.pixels.rmse},
                               {"ssim", m.pixels.ssim},
                               {"page", m.page.string()}});
        list.push_back({{"scene", r.file.string()},
                        {"pass", r.passes()},
                        {"verdict", !r.error.empty()       ? r.error
                                    : !r.complaint.empty() ? r.complaint
                                    : !r.physics.empty()   ? r.physics
                                    : r.passes()           ? "same"
                                                           : "drawing changed, physics the same"},
                        {"exact", r.exact},
                        {"seconds", r.seconds},
                        {"updates", r.updates},
                        {"frames", moments}});
    }
    return list.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<JunitCase> junit_cases(const std::vector<SceneResult>& results) {
    std::vector<JunitCase> cases;
    for (const SceneResult& r : results) {
        const std::string failure = !r.complaint.empty() ? r.complaint : r.physics;
        cases.push_back({r.name, "physics", r.seconds, failure, r.error});
        for (const MomentResult& m : r.moments) cases.push_back({r.name, m.moment, 0, m.complaint, ""});
    }
    return cases;
}

/// What an earlier test left of this scene.
void clear(const fs::path& folder) {
    if (!fs::exists(folder)) return;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename() == "run" || fs::exists(entry.path() / "difference.html"))
            fs::remove_all(entry.path());
}

void test_scene(SceneResult& r, const TestOptions& options, int threads, std::mutex& drawing) {
    const auto begin = std::chrono::steady_clock::now();
    const fs::path folder = options.output / r.name;
    clear(folder);
    run_scene(r, folder / "run", threads);
    if (!r.error.empty()) return;
    {
        const RunReader run(folder / "run");
        const std::lock_guard lock(drawing);
        const DrawnTest drawn = draw_test(r.scene, run, options.renderer);
        compare(r, drawn, options);
        if (options.update != Update::none) update(r, drawn, options.update);
    }
    // The run of a failure stays, to be looked at.
    if (r.passes()) {
        fs::remove_all(folder / "run");
        if (fs::is_empty(folder)) fs::remove(folder);
    }
    r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

int test_command(const TestOptions& options) {
    const char* ci = std::getenv("CI");
    if (options.update != Update::none && ci && ci == std::string("true"))
        throw std::invalid_argument(
            "--update: references are not renewed where CI=true is set, since nobody looks at the pictures "
            "there; "
            "renew them at home and commit them");
    std::vector<SceneResult> results = read_all(options);
    const int count = static_cast<int>(results.size());
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    const int jobs = std::min(count, options.jobs > 0 ? options.jobs : cores);
    Progress progress("testing", "scenes", options.quiet || options.json);
    std::mutex drawing;  // the contexts of one process are not for several threads at once
    int done = 0;
    in_parallel(
        count, jobs,
        [&](int k) {
            try {
                test_scene(results[k], options, std::max(1, cores / jobs), drawing);
            } catch (const std::exception& error) {  // one scene that fails stops no other
                results[k].error = error.what();
            }
        },
        [&] {
            ++done;
            progress.at(static_cast<double>(done) / count, done);
        });
    if (options.junit) write_junit(*options.junit, "hibi test", junit_cases(results));
    if (options.json) {
        fmt::print("{}", to_json(results));
    } else {
        for (const SceneResult& r : results) fmt::print("{}\n", line_of(r));
        const auto passed = std::ranges::count_if(results, &SceneResult::passes);
        fmt::print("{} of {} scenes pass\n", passed, count);
    }
    const auto failed = [](const SceneResult& r) { return !r.error.empty(); };
    if (std::ranges::any_of(results, failed)) return 1;
    return std::ranges::all_of(results, &SceneResult::passes) ? 0 : 3;
}

}  // namespace hibi
