#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "record/run_folder.hpp"

namespace hibi {

/// How much two runs may differ and still count as the same physics. Two runs of one program on one kind of
/// processor are equal to the last bit; the limits leave room for what other compilers and processors round.
struct RunTolerance {
    /// Of positions, in particle spacings: a hundredth is less than a pixel in any film.
    double position = 0.01;
    /// By how many steps a bond may break earlier or later.
    int break_steps = 0;
    /// Of loads, in parts of the peak load.
    double load = 0.001;
};

/// Positions of all particles at all moments that both runs recorded.
struct PositionsDifference {
    int compared = 0;           ///< moments
    bool interpolated = false;  ///< between the states of the second run, since its time step is another
    struct Place {
        double distance = 0;  ///< between the two positions (m); infinite where one is not a number
        double spacings = 0;  ///< the same over the particle's spacing
        double time = 0;      ///< (s)
        int particle = 0;
        Vec3 reference_position = Vec3::Zero();  ///< (m)
    };
    std::optional<Place> largest{};       ///< in spacings; nothing where all are equal
    std::optional<Place> first_beyond{};  ///< at the first moment beyond the tolerance, its largest
};

/// A bond that broke at another time, or in one of the runs only.
struct BondChange {
    int bond = 0, first = 0, second = 0;  ///< its index and its particles
    double expected = 0, actual = 0;      ///< time of breaking (s); infinity where it did not break
    std::int64_t steps = 0;  ///< actual - expected, in steps of the expected run; 0 where one did not break
    /// When the runs went apart there (s).
    double time() const;
};
struct BondsDifference {
    int expected_broken = 0, actual_broken = 0;
    int changed = 0;                    ///< bonds beyond the tolerance
    int other_step = 0;                 ///< of the others, those that broke at another time
    std::optional<BondChange> first{};  ///< the earliest of the changed
};

/// The primary load. Nothing of it depends on which particles there are.
struct CurveDifference {
    struct Pair {
        std::optional<double> expected{}, actual{};  ///< (N); nothing where it did not happen
        bool same(double limit) const;               ///< both or neither, and within the limit (N)
    };
    Pair peak, first_break;  ///< load at the event
    double scale = 0;        ///< largest load of the expected run (N)
    double largest = 0;      ///< difference at any of 1000 moments that both runs reached (N)
    double largest_time = 0;
    std::optional<double> first_beyond{};  ///< first of the moments beyond the tolerance (s)
};

struct RunDifference {
    /// Why positions and bonds cannot be compared ("800 particles, not 200"); empty where they can.
    std::string other_body{};
    PositionsDifference positions{};
    BondsDifference bonds{};
    std::optional<CurveDifference> curve{};   ///< nothing where neither run has a load
    double expected_end = 0, actual_end = 0;  ///< (s)
    bool identical = true;                    ///< everything above, to the last bit
    bool same = true;                         ///< within the tolerance
};

/// Compares two recorded runs. Every state that both have is read; errors name the file that cannot be.
RunDifference difference(const RunReader& expected, const RunReader& actual, const RunTolerance& tolerance);

/// A change of one bond in words: "bond 311-352 broke 3 steps earlier", "bond 311-352 broke, which it did
/// not".
std::string describe(const BondChange& change);
/// "+1.8 %", and "none" for what did not happen.
std::string relative_change(const CurveDifference::Pair& pair);

/// What changed first, and what became of the loads, in one line: "physics changed first at t = 1.284 s: bond
/// 311-352 broke 3 steps earlier; peak load +1.8 %". Only for runs that are not the same.
std::string physics_verdict(const RunDifference& difference, const RunTolerance& tolerance);

}  // namespace hibi
