#pragma once
#include <string>

#include "record/run_folder.hpp"

namespace hibi {

/// What happened in a run, as a table for a terminal. `made` is what its user looks at first; `pictures`:
/// they were drawn.
std::string results_text(const RunSummary& summary, const std::string& made, bool pictures);

/// What was measured of the run, and of the drawing where there was one.
std::string profile_text(const RunSummary& summary, bool drawn);

}  // namespace hibi
