#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/film_plan.hpp"
#include "record/run_folder.hpp"
#include "render/renderer.hpp"

namespace hibi {

/// Turns recorded states into pictures at any moment, in any order, but cheaply only with rising time: two
/// states are kept. Displacements and values are interpolated between states, bonds never: one is broken iff
/// broken_at <= time.
class PictureSource {
 public:
    PictureSource(const RunReader& run, const View& view, const std::array<double, 2>& range);

    /// Everything but camera and freshness, which is 0.
    Picture2 at(double time);
    const std::vector<double>& x() const { return x_; }  ///< of the last picture, particle by particle (m)
    const std::vector<double>& y() const { return y_; }

 private:
    struct Loaded {
        int state = -1;
        std::vector<Vec3> displacement;
        std::vector<float> value;
    };
    const Loaded& load(int state, int keep);

    const RunReader& run_;
    View view_;
    std::array<double, 2> range_;
    std::vector<int> intact_candidates_, by_time_of_break_;
    Loaded loaded_[2];
    std::vector<double> x_, y_;
};

/// Bonds that are drawn while they are intact: none, those of nearest neighbours (rest_length <= 1.01 l0), or
/// all.
std::vector<int> drawn_bonds(const Topology& topology, const std::string& which);

}  // namespace hibi
