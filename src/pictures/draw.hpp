#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "base/stage_time.hpp"
#include "record/run_folder.hpp"
#include "render/renderer.hpp"
#include "scene/read.hpp"

namespace hibi {

struct DrawOptions {
    RendererOptions renderer{};
    bool movie = true;                   ///< films beside frames and poster
    std::vector<std::string> formats{};  ///< of the films; empty: what the scene says
    bool frames = true;                  ///< keep the PNG frames
    bool report = true;                  ///< figures and report; not by draw_run itself
    int workers = 2;  ///< threads that hash and write PNG frames; the pictures do not depend on it
    std::vector<std::string> command{};  ///< words of the command that draws, where it is not the run's own
    std::function<void(int done, int total)> progress{};
};

struct DrawResult {
    int frames = 0;
    double draw_seconds = 0, encode_seconds = 0;  ///< wall time; and the encoder's own share
    double processor_seconds = 0;                 ///< of all threads of the program meanwhile
    std::string renderer;
};

/// frames/, frames.json, movie.mp4 (or other formats) and poster.png of a recorded run, from its states
/// alone: the one way pictures are made, by `run` as by `render`. Frames, PNG workers and the encoder
/// overlap. Pictures of an earlier drawing are removed first. Without movie and frames only the poster is
/// drawn. Errors (std::runtime_error) name the file; what was finished by then stays.
DrawResult draw_run(const Scene& scene, const std::filesystem::path& folder, const DrawOptions& options);

/// The stages of a drawing, in the order in which a frame goes through them.
StageTimes drawing_stages();

/// The formats that films are made in: none, those of the options, or those of the scene.
std::vector<std::string> films(const Scene& scene, const DrawOptions& options);

/// Name of the film in a folder, the most usual format first; empty where there is none.
std::string film_in(const std::filesystem::path& folder);

/// The body as it stands before the run, with supports, loads at full size and notches. `command` goes into
/// the picture.
void draw_setup(const BuiltScene& setup, const std::filesystem::path& png, const RendererOptions& renderer,
                const std::string& command = {});

}  // namespace hibi
