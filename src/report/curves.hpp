#pragma once
#include <vector>

#include "image/chart.hpp"
#include "results/history.hpp"
#include "results/moment.hpp"

namespace hibi {

/// The charts of a run: load over displacement up to separation, where there is a load, and the energies over
/// time, both up to separation, with first break, peak load and separation marked. Empty for a history of
/// fewer than two rows.
std::vector<Chart> run_charts(const History& history, const Events& events);

}  // namespace hibi
