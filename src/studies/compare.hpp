#pragma once
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/renderer.hpp"
#include "results/moment.hpp"

namespace hibi {

struct CompareOptions {
    std::vector<std::filesystem::path> folders;    ///< of two recorded runs or more
    std::vector<std::string> labels{};             ///< one per run; empty: what tells them apart
    std::filesystem::path output = "out/compare";  ///< folder of movie.mp4, poster.png, frames/
    std::string title{};                           ///< empty: that of the first run
    std::optional<EventName> align{};              ///< event at which all clocks agree; absent: zero
    int columns = 0;                               ///< panels in a row; 0: so that the bodies are largest
    std::optional<std::array<int, 2>> size{};      ///< (pixels); absent: that of the first run's film
    std::vector<std::string> formats{};            ///< of the film; empty: those of the first run
    bool force = false;                            ///< write into a folder that holds other things
    bool quiet = false;
    RendererOptions renderer{};
};

/// One film of several runs in panels, each with its label, on one clock, at one scale and with one colour
/// range: movie.mp4, poster.png, frames/ and frames.json. A run that has ended stands still. Throws
/// std::invalid_argument where the runs cannot be compared, std::runtime_error for the world's faults.
void make_comparison(const CompareOptions& options);

}  // namespace hibi
