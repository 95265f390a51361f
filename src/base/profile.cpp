#include "base/profile.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>

namespace hibi {

double processor_seconds() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

std::string profile_table(const std::string& title, const std::vector<StageTime>& stages, double wall) {
    std::size_t width = title.size();
    for (const StageTime& stage : stages) width = std::max(width, stage.name.size());
    std::string text = fmt::format("{:<{}} {:>10} {:>7} {:>9} {:>11}\n", title, width, "seconds", "of wall",
                                   "calls", "ms per call");
    for (const StageTime& s : stages)
        text += fmt::format("{:<{}} {:>10.3f} {:>5.1f} % {:>9} {:>11.3f}\n", s.name, width, s.seconds,
                            wall > 0 ? 100 * s.seconds / wall : 0, s.calls,
                            1000 * s.seconds / static_cast<double>(std::max<std::int64_t>(1, s.calls)));
    return text;
}

}  // namespace hibi
