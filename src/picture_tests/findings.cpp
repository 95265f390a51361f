#include "picture_tests/findings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "picture_tests/diff.hpp"
#include "record/files.hpp"

namespace hibi {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Throws where one of the two has frames that the other lacks.
void require_same_names(const NamedFiles& expected, const NamedFiles& actual, const DiffOptions& options) {
    const auto lacks = [](const NamedFiles& all, const NamedFiles& some, const fs::path& where) {
        std::vector<std::string> missing;
        for (const auto& [name, file] : all)
            if (!some.contains(name)) missing.push_back(name);
        if (missing.empty()) return;
        refuse_to_compare(fmt::format(
            "{}: lacks {} of {} frames, the first of them {}; compare films of the same length, or "
            "draw this one again",
            where.string(), missing.size(), all.size(), missing.front()));
    };
    lacks(expected, actual, options.actual);
    lacks(actual, expected, options.expected);
}

Sameness worst_of(const std::vector<FrameDifference>& frames) {
    Sameness worst = Sameness::identical;
    for (const FrameDifference& f : frames) worst = std::max(worst, f.sameness);
    return worst;
}

std::string drawing_words(const Findings& f, const DiffOptions& options) {
    if (!f.other_frames.empty()) return f.other_frames;
    const auto differing = std::ranges::count(f.frames, Sameness::different, &FrameDifference::sameness);
    std::string text = f.frames.size() == 1 ? ""
                                            : fmt::format("{} of {} frames, worst {}: ", differing,
                                                          f.frames.size(), f.worst->name);
    return text + beyond(f.worst->pixels, options.pixels);
}

std::string not_compared_words(const std::vector<std::string>& names) {
    constexpr std::size_t most = 3;
    const std::size_t shown = std::min(most, names.size());
    std::string text = fmt::format("not the same, but not compared: {}",
                                   fmt::join(names.begin(), names.begin() + shown, ", "));
    if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
    return text;
}

void set_verdict(Findings& f, const DiffOptions& options) {
    if (f.all() != Sameness::different) {
        f.verdict = "same";
        f.detail = to_string(f.all());
    } else if (f.physics == Sameness::different) {
        f.verdict = physics_verdict(*f.run, options.run);
    } else {
        f.verdict = f.run ? "drawing changed, physics the same" : "different";
        f.detail = drawing_words(f, options);
    }
    if (!f.not_compared.empty()) f.detail += "; " + not_compared_words(f.not_compared);
}

/// The pictures of two runs, where both were drawn. That one has more of them is a finding, not a mistake.
void compare_drawings(const DiffOptions& options, Findings& f) {
    const auto frames_of = [](const fs::path& folder) {
        return fs::exists(folder / "frames.json") ? listed_frames(folder) : NamedFiles{};
    };
    const NamedFiles expected = frames_of(options.expected), actual = frames_of(options.actual);
    if (expected.empty() || actual.empty()) {
        f.other_frames = fmt::format("{} has no frames, so pixels are not compared; hibi render draws them",
                                     (expected.empty() ? options.expected : options.actual).string());
        return;
    }
    if (expected.size() != actual.size()) {
        f.other_frames = fmt::format("{} frames, not {}", actual.size(), expected.size());
        f.pixels = Sameness::different;
        return;
    }
    f.frames = compare_files(expected, actual, options.pixels);
}

/// A run that came to its end has all the states, rows and breaks that it counted: what is gone must not pass
/// unseen.
void require_complete(const RunReader& run) {
    if (run.summary().stopped) return;
    const auto broken =
        std::ranges::count_if(run.broken_at(), [](double time) { return std::isfinite(time); });
    if (broken != run.summary().broken)
        throw std::runtime_error(fmt::format("{}: holds {} broken bonds, and run.json counts {}",
                                             (run.folder() / "breaks.csv").string(), broken,
                                             run.summary().broken));
    const std::vector<HistoryRow>& rows = run.history().rows;
    if (rows.empty() || rows.back().time < run.summary().end_time)
        throw std::runtime_error(
            fmt::format("{}: ends before the run does", (run.folder() / "history.csv").string()));
    const fs::path series = run.folder() / "states.hdf.series";
    try {
        const Json list = Json::parse(read_file(series));
        for (const Json& state : list.at("files"))
            if (const fs::path file = run.folder() / state.at("name").get<std::string>(); !fs::exists(file))
                throw std::runtime_error(fmt::format("{}: is missing, though {} lists it", file.string(),
                                                     series.filename().string()));
    } catch (const Json::exception& error) {
        throw std::runtime_error(fmt::format("{}: not a list of states: {}", series.string(), error.what()));
    }
}

}  // namespace

Findings find(const DiffOptions& options) {
    const ComparedKind kind = kind_of(options.expected), other = kind_of(options.actual);
    if (kind != other)
        refuse_to_compare(fmt::format("{} is {}, {} is {}; compare two of a kind", options.expected.string(),
                                      to_string(kind), options.actual.string(), to_string(other)));
    Findings f;
    if (kind == ComparedKind::picture) {
        f.frames = compare_pictures(options.actual.filename().string(), options.expected, options.actual,
                                    options.pixels);
    } else if (kind == ComparedKind::frames) {
        const FolderFiles expected = files_to_compare(options.expected, options.output),
                          actual = files_to_compare(options.actual, options.output);
        require_same_names(expected.pictures, actual.pictures, options);
        f.frames = compare_files(expected.pictures, actual.pictures, options.pixels);
        f.not_compared = differing_files(expected.others, actual.others);
    } else {
        f.run = read_as_input("run the scene again, or compare other runs", [&] {
            const RunReader expected(options.expected), actual(options.actual);
            require_complete(expected);
            require_complete(actual);
            return difference(expected, actual, options.run);
        });
        f.physics = f.run->identical ? Sameness::identical
                    : f.run->same    ? Sameness::tolerated
                                     : Sameness::different;
        compare_drawings(options, f);
    }
    if (!f.frames.empty()) {
        f.pixels = worst_of(f.frames);
        f.worst = &*std::ranges::max_element(
            f.frames, {}, [&](const FrameDifference& frame) { return badness(frame, options.pixels); });
    }
    set_verdict(f, options);
    return f;
}

}  // namespace hibi
