#include "base/stage_time.hpp"

#include <algorithm>

namespace hibi {

StageTimes::StageTimes(const std::vector<std::string>& names) {
    for (const std::string& name : names) stages_.push_back({.name = name});
}

void StageTimes::add(const char* name, double seconds, std::int64_t calls) {
    const std::lock_guard lock(mutex_);
    auto stage = std::ranges::find(stages_, name, &StageTime::name);
    if (stage == stages_.end()) stage = stages_.insert(stages_.end(), {.name = name});
    stage->seconds += seconds;
    stage->calls += calls;
}

std::vector<StageTime> StageTimes::list() const {
    const std::lock_guard lock(mutex_);
    std::vector<StageTime> used;
    std::ranges::copy_if(stages_, std::back_inserter(used), [](const StageTime& s) { return s.calls > 0; });
    return used;
}

}  // namespace hibi
