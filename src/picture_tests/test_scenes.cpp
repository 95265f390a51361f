#include "picture_tests/test_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "base/process.hpp"
#include "base/progress.hpp"
#include "picture_tests/compare_reference.hpp"
#include "picture_tests/diff.hpp"
#include "record/provenance.hpp"
#include "scene/scene_file.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;

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
        compare_with_reference(r, drawn, options.output);
        if (options.update != Update::none) update_reference(r, drawn, options.update);
    }
    // The run of a failure stays, to be looked at.
    if (r.passes()) {
        fs::remove_all(folder / "run");
        if (fs::is_empty(folder)) fs::remove(folder);
    }
    r.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

std::vector<SceneResult> test_scenes(const TestOptions& options) {
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
    return results;
}

}  // namespace hibi
