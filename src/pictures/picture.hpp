#pragma once
#include <array>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/stage_time.hpp"
#include "pictures/film_plan.hpp"
#include "record/run_folder.hpp"
#include "render/renderer.hpp"

namespace hibi {

/// Turns recorded states into pictures at any moment, in any order, but cheaply only with rising time: two
/// states are kept, and while others are read ahead those too. Displacements and values are interpolated
/// between states, bonds never: one is broken iff broken_at <= time.
class PictureSource {
 public:
    /// The run is kept as a reference. Positions are counted from the origin (m).
    PictureSource(const RunReader& run, const View& view, const std::array<double, 2>& range,
                  const Vec3& origin = Vec3::Zero(), StageTimes* profile = nullptr);

    PictureSource(const PictureSource&) = delete;  // what is read ahead knows its place

    /// Everything but camera and freshness, which is 0, and history, which is empty; intact bonds only if
    /// wanted. It is the caller's until the next call.
    Picture2& at(double time, bool with_intact = true);
    /// Begins to read what the picture at this time needs, on a thread of its own. A state that cannot be
    /// read is an error of the picture that needs it.
    void expect(double time);
    const std::vector<double>& x() const { return x_; }  ///< of the last picture, particle by particle, counted from the origin (m)
    const std::vector<double>& y() const { return y_; }

 private:
    struct Loaded {
        std::vector<double> x{}, y{};  ///< displacement (m)
        std::vector<float> value{};
    };
    /// Where a time lies: two states, or one twice, and the part of the way to the second.
    struct Between {
        int before = 0, after = 0;
        double share = 0;
    };
    using States = std::map<int, Loaded>;  ///< by number
    Between between(double time) const;
    Loaded read(int state) const;
    void load(const Between& wanted);
    void interpolate(const Loaded& before, const Loaded& after, double share);
    void sort_bonds(double time, bool with_intact);

    const RunReader& run_;
    View view_;
    std::array<double, 2> range_;
    const Topology& topology_;  ///< positions counted from the origin
    StageTimes* profile_;
    std::optional<std::vector<int>> intact_candidates_{};  ///< found when they are first wanted
    std::vector<int> by_time_of_break_;
    States loaded_;
    std::future<States> coming_;
    std::vector<double> x_, y_;
    Picture2 picture_;
    std::optional<std::size_t> intact_at_{};  ///< number of broken bonds that picture_.intact belongs to
};

/// Bonds that are drawn while they are intact: none, those of nearest neighbours (rest_length <= 1.01 l0), or
/// all.
std::vector<int> drawn_bonds(const Topology& topology, const std::string& which);

}  // namespace hibi
