#pragma once
#include <string>
#include <vector>

#include "record/run_folder.hpp"
#include "results/history.hpp"

namespace hibi {

struct PageKeyFrame {
    double time = 0;  ///< simulated (s)
    std::string label, detail;
    std::string light, dark;  ///< PNG, for either theme
};

/// Everything a report shows. Pictures and film are bytes, since the page is one file.
struct PageContent {
    RunSummary summary;
    std::string about;        ///< of the scene; may be empty
    std::string description;  ///< counts and materials in one line
    History history;
    std::string scene;  ///< scene.toml
    std::string caption;
    std::string poster;      ///< PNG; empty: left out. It stands there until the film plays
    double poster_time = 0;  ///< simulated time that it shows (s)
    std::string cracks_light, cracks_dark;  ///< PNG, for either theme; empty: left out
    std::string film;                 ///< empty: the poster stands in its place
    std::string film_type;            ///< video/mp4 or video/webm
    std::vector<double> frame_times;  ///< simulated time of each frame of the film (s)
    int fps = 25;
    std::vector<PageKeyFrame> key_frames;
};

/// One offline HTML page: film, curves whose cursor follows the film and moves it, key frames, results,
/// energy verdict, scene, and the command that makes it again. Light and dark, for screen, phone and print.
/// It asks nothing of a network.
std::string report_page(const PageContent& content);

}  // namespace hibi
