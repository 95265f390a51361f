#pragma once
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "image/overlay.hpp"
#include "image/text.hpp"
#include "studies/compared_runs.hpp"

namespace hibi {

/// Several runs in panels side by side, ready to be drawn frame by frame.
class Comparison {
 public:
    Comparison(const CompareOptions& options, std::vector<ComparedRun> runs);

    int width() const { return view_.width; }
    int height() const { return view_.height; }
    int frames() const { return static_cast<int>(runs_[0].plan.time.size()); }
    double clock(int frame) const { return runs_[0].plan.time[frame] - runs_[0].zero; }
    const FilmPlan& plan(int run) const { return runs_[run].plan; }

    /// Of the frames that tell most of each run, the middle one.
    int poster() const;
    /// Returns how many bonds are shown as broken.
    int draw(int frame, Image& image, std::optional<int> next = {});

 private:
    void fill(Image& image) const;
    void draw_labels(int frame, Image& image) const;
    double last_end() const;
    OverlayContent content(const CompareOptions& options, const std::array<double, 2>& range) const;

    std::vector<ComparedRun> runs_;
    TimeMap clock_;
    View view_;
    std::unique_ptr<Overlay> overlay_;
    Typesetter type_;
    double text_ = 0;
    Image panel_;
};

}  // namespace hibi
