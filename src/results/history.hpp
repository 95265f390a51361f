#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/vec.hpp"

namespace hibi {

/// The cracks of a plane body at one moment, in the reference configuration; see Cracks.
struct CrackReading {
    double length = 0;          ///< of all cracks together, notches not counted (m)
    std::optional<Vec3> tip{};  ///< of the leading crack (m); empty before the first break
    double speed = 0;           ///< of that tip (m/s)
};

/// What the intact bonds still hold together; see find_fragments.
struct Fragments {
    int count = 0;       ///< connected parts of two particles or more
    double largest = 0;  ///< mass of the heaviest of them (kg)
    double debris = 0;   ///< mass of all particles without an intact bond (kg)

    template <class Self, class Visit>
    static void each_field(Self& self, Visit&& visit) {
        visit("count", self.count);
        visit("largest", self.largest);
        visit("debris", self.debris);
    }
};

/// One row of history.csv; all values at the same time. SI units.
struct HistoryRow {
    double time = 0, load = 0, displacement = 0;  ///< of the primary load
    double kinetic = 0, elastic = 0, contact = 0, damped = 0, released = 0, work = 0;  ///< (J)
    double imbalance =
        0;  ///< |kinetic + elastic + contact + damped + released - work| over the scale so far [-]
    int broken = 0;
    Vec3 momentum = Vec3::Zero();  ///< (kg m/s)
    CrackReading crack{};
    Fragments fragments{};
    std::vector<double> loads{}, displacements{};  ///< per load, in the order of History::load_names
};

struct History {
    int dimension = 2;
    std::vector<std::string> load_names;
    std::vector<HistoryRow> rows;
};

/// One row of breaks.csv.
struct Break {
    double time = 0;
    int bond = 0, first = 0, second = 0;
    Vec3 position = Vec3::Zero();  ///< of the bond's middle when it broke (m)
    double strain = 0;             ///< bond strain when it broke, signed [-]
};

}  // namespace hibi
