#pragma once
#include <string>

namespace hibi {

/// What a named part of the work took, all threads waiting included (s).
struct StageTime {
    std::string name;
    double seconds = 0;
};

}  // namespace hibi
