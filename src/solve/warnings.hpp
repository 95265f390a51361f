#pragma once
#include <string>
#include <vector>

#include "simulation/simulation.hpp"
#include "record/run_folder.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// What a user must know before trusting a run that came to its end, in whole sentences. `damping_rate` is
/// that of the beginning (1/s), `largest_strain` the largest size of the strain of an intact bond that was
/// recorded
/// [-].
std::vector<std::string> run_warnings(const Scene& scene, const Simulation& simulation,
                                      const RunSummary& summary, double damping_rate, double largest_strain);

}  // namespace hibi
