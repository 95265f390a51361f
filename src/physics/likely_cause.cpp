#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "physics/mover.hpp"

namespace hibi {

template <int Dim>
std::string likely_cause(const Model<Dim>& model, const State<Dim>& state, const Mover<Dim>& mover) {
    const double step = mover.time_step(), stable = mover.stable_time_step();
    if (stable > 0 && step > 0.95 * stable)
        return fmt::format("the time step {:.3g} s is too close to the stable {:.3g} s: leave it out", step,
                           stable);
    double largest = 0;
    const Bonds& bonds = model.bonds;
    for (int b = 0; b < bonds.count(); ++b) {
        if (!state.is_intact(b)) continue;
        const double length =
            (position(model, state, bonds.second[b]) - position(model, state, bonds.first[b])).norm();
        largest = std::max(largest, std::abs(length / bonds.rest_length[b] - 1));
    }
    if (!(largest < 0.5))
        return "intact bonds are stretched or squeezed by more than half their length: give the material a "
               "break_strain, lower the load, or raise it more slowly";
    return "the load or the prescribed motion may be far too large for the material: are their units right?";
}

template std::string likely_cause<2>(const Model<2>&, const State<2>&, const Mover<2>&);
template std::string likely_cause<3>(const Model<3>&, const State<3>&, const Mover<3>&);

}  // namespace hibi
