#pragma once
#include <string>
#include <vector>

#include "base/vec.hpp"

namespace hibi {

/// One row of history.csv; all values at the same time. SI units.
struct HistoryRow {
    double time = 0, load = 0, displacement = 0;  ///< of the primary load
    double kinetic = 0, elastic = 0, contact = 0, damped = 0, released = 0, work = 0;  ///< (J)
    double imbalance = 0;  ///< |kinetic + elastic + contact + damped + released - work| over the scale so far [-]
    int broken = 0;
    Vec3 momentum = Vec3::Zero();            ///< (kg m/s)
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
