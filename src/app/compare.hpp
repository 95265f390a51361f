#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "measure/moment.hpp"
#include "render/renderer.hpp"

namespace hibi {

struct CompareOptions {
    std::vector<std::filesystem::path> folders;    ///< of two recorded runs or more
    std::vector<std::string> labels{};             ///< one per run; empty: what tells them apart
    std::filesystem::path output = "out/compare";  ///< folder of movie.mp4, poster.png, frames/
    std::string title{};                           ///< empty: what the runs have in common
    std::optional<EventName> align{};              ///< event at which all clocks agree; absent: their start
    bool quiet = false;
    RendererOptions renderer{};
};

/// `hibi compare`: one film of several runs, side by side or stacked, on one clock and with one colour range,
/// a label on each. Returns the exit status: 2 where the runs cannot be compared (an event that one of them
/// lacks, other dimensions of the coloured field).
int compare_command(const CompareOptions& options);

}  // namespace hibi
