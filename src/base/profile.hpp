#pragma once
#include <string>
#include <vector>

#include "base/stage_time.hpp"

namespace hibi {

/// Processor time of all threads of the program so far (s).
double processor_seconds();

/// One line per stage: its share of `wall` (s), how often it was entered, and milliseconds per call. Stages
/// of different threads overlap.
std::string profile_table(const std::string& title, const std::vector<StageTime>& stages, double wall);

}  // namespace hibi
