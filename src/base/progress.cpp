#include "base/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace hibi {

namespace {

constexpr double bar_interval = 0.1, line_interval = 10;  // s

std::string remaining(double seconds) {
    if (!(seconds < 360000)) return "";
    if (seconds < 100) return fmt::format("{:.0f} s left", seconds);
    return fmt::format("{:.0f} min left", seconds / 60);
}

}  // namespace

Progress::Progress(std::string what, std::string unit, bool quiet)
    : what_(std::move(what)), unit_(std::move(unit)), quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
    if (terminal_ && printed_) fmt::print(stderr, "\r\033[K");
}

void Progress::at(double fraction, double count, const std::string& note) {
    if (quiet_) return;
    const Clock::time_point now = Clock::now();
    const auto seconds = [&](Clock::time_point since) {
        return std::chrono::duration<double>(now - since).count();
    };
    if (seconds(last_) < (terminal_ ? bar_interval : line_interval)) return;
    last_ = now;
    printed_ = true;
    fraction = std::clamp(fraction, 0.0, 1.0);
    const double elapsed = seconds(begin_);
    const std::string rate = fmt::format("{:.3g} {}/s", count / elapsed, unit_);
    const std::string left = fraction > 0 ? remaining(elapsed * (1 - fraction) / fraction) : "";
    const char* comma = note.empty() ? "" : ", ";
    if (terminal_) {
        constexpr int width = 24;
        const int filled = static_cast<int>(std::lround(fraction * width));
        fmt::print(stderr, "\r\033[K{:<9} [{:#<{}}{:.<{}}] {:3.0f} %  {}  {}{}{}", what_, "", filled, "",
                   width - filled, 100 * fraction, rate, left, comma, note);
    } else {
        fmt::print(stderr, "{} {:.0f} %, {}, {}{}{}\n", what_, 100 * fraction, rate, left, comma, note);
    }
    std::fflush(stderr);
}

}  // namespace hibi
