#pragma once
#include <chrono>
#include <string>

namespace hibi {

/// Progress on standard error: a bar with rate and remaining time on a terminal, otherwise a line every ten
/// seconds.
class Progress {
 public:
    Progress(std::string what, std::string unit, bool quiet);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// fraction 0..1 of the work; count: steps or frames so far; note: a few words on where things stand.
    void at(double fraction, double count, const std::string& note = {});

 private:
    using Clock = std::chrono::steady_clock;
    std::string what_, unit_;
    bool quiet_, terminal_, printed_ = false;
    Clock::time_point begin_ = Clock::now(), last_ = begin_;
};

}  // namespace hibi
