#pragma once
#include <filesystem>

#include "scene/read.hpp"
#include "solve/quasi_static.hpp"

namespace hibi {

struct CheckOptions {
    std::filesystem::path scene{};
    Overrides overrides{};
    bool json = false;
    int most_particles_for_period = hibi::most_particles_for_period;  ///< beyond, the first mode is left out
};

/// `hibi check`: reads and builds a scene and prints what would be modelled: counts, supports, loads, the
/// stages of a step, the time step, what it will cost, and the scene with every default filled in. Nothing is
/// run but a few steps to measure their speed. Returns the exit status; throws SceneErrors for a wrong scene.
int check_command(const CheckOptions& options);

}  // namespace hibi
