#pragma once
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pictures/run_drawing.hpp"
#include "scene/scene.hpp"
#include "studies/compare.hpp"

namespace hibi {

/// A run, and where its zero lies on the common clock.
struct ComparedRun {
    Scene scene;
    std::unique_ptr<RunReader> run;
    std::string label;
    double zero = 0;  ///< simulated time at which the common clock says 0 (s)
    FilmPlan plan{.map = TimeMap(0, 0, 1, {}, {})};
    std::unique_ptr<RunDrawing> drawing{};
    PixelRect cell{};  ///< label and picture, in the frame

    double begin() const { return run->states().front().time - zero; }
    double end() const { return run->states().back().time - zero; }
};

/// What tells runs apart: parameters that differ, else titles, else folders.
std::vector<std::string> labels_of(const std::vector<std::filesystem::path>& folders);

/// Throws std::invalid_argument where the runs cannot be compared.
std::vector<ComparedRun> read_compared_runs(const CompareOptions& options);

/// From the first beginning to the last end; slow where the first run's scene says so, else from the earliest
/// first break to the latest separation.
TimeMap common_clock(const std::vector<ComparedRun>& runs);

/// Gives each run the plan of its film on the common clock.
void plan_films(std::vector<ComparedRun>& runs, const TimeMap& clock);

/// Box around the bodies of all runs, counted from the origin (m): x0, y0, x1, y1.
std::array<double, 4> common_box(const std::vector<ComparedRun>& runs, const Vec3& origin);

/// Of the colours, in the field's SI unit.
std::array<double, 2> common_range(const std::vector<ComparedRun>& runs, const View& view);

}  // namespace hibi
