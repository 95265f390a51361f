#include "record/leftovers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

namespace hibi {

namespace {

/// Everything a run writes beside its states and frames.
constexpr const char* tables[] = {"history.csv", "breaks.csv", "scene.toml", "run.json", "states.hdf.series"};
constexpr const char* pictures[] = {"poster.png",          "frames.json",       "strip.png",
                                    "cracks.png",          "curve.png",         "curve.svg",
                                    "report.html",         "caption.md",        "snippets/figure.tex",
                                    "snippets/figure.qmd", "snippets/figure.md"};

void remove_one(const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::remove(file, error);
    if (error)
        throw std::runtime_error(
            fmt::format("{}: cannot remove what an earlier run left: {}", file.string(), error.message()));
}

void remove_with_unfinished(const std::filesystem::path& file) {
    remove_one(file);
    remove_one(file.string() + ".tmp");
}

/// 000000.hdf, 000000.hdf.tmp
bool is_numbered(const std::string& name, const std::string& extension) {
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    const std::string rest = name.substr(digits);
    return digits > 0 && (rest == extension || rest == extension + ".tmp");
}

void remove_numbered(const std::filesystem::path& folder, const std::string& extension) {
    if (!std::filesystem::is_directory(folder)) return;
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (is_numbered(entry.path().filename().string(), extension)) files.push_back(entry.path());
    std::ranges::for_each(files, remove_one);
    if (std::filesystem::is_empty(folder)) remove_one(folder);
}

/// strip_print_85mm.png and its like.
void remove_figures(const std::filesystem::path& folder) {
    if (!std::filesystem::is_directory(folder)) return;
    static const std::regex figure(R"((strip|cracks|curve)_[a-z]+_[0-9.]+mm\.(png|svg)(\.tmp)?)");
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (std::regex_match(entry.path().filename().string(), figure)) files.push_back(entry.path());
    std::ranges::for_each(files, remove_one);
}

}  // namespace

void remove_leftovers(const std::filesystem::path& folder) {
    remove_pictures(folder);
    for (const char* name : tables) remove_with_unfinished(folder / name);
    remove_with_unfinished(folder / "states" / "topology.hdf");
    remove_numbered(folder / "states", ".hdf");
}

void remove_pictures(const std::filesystem::path& folder, bool films) {
    for (const char* name : pictures) remove_with_unfinished(folder / name);
    for (const char* type : {"mp4", "gif", "webm", "apng", "webp"})
        for (const char* stage : {"", ".part", ".whole"})
            if (films || *stage) remove_one(folder / fmt::format("movie{}.{}", stage, type));
    remove_numbered(folder / "frames", ".png");
    remove_figures(folder / "figures");
    for (const char* name : {"figures", "snippets"})
        if (std::filesystem::is_directory(folder / name) && std::filesystem::is_empty(folder / name))
            remove_one(folder / name);
}

bool holds_run(const std::filesystem::path& folder) {
    return std::filesystem::exists(folder / "run.json") ||
           std::filesystem::exists(folder / "states" / "topology.hdf");
}

}  // namespace hibi
