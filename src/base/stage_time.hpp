#pragma once
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

namespace hibi {

/// What one part of a job took, all its calls together.
struct StageTime {
    std::string name;
    double seconds = 0;  ///< of wall time, on the thread that did it
    std::int64_t calls = 0;
};

/// Collects them, from any thread.
class StageTimes {
 public:
    /// Stages stand in this order, those first named later behind them.
    explicit StageTimes(const std::vector<std::string>& names);
    void add(const char* name, double seconds, std::int64_t calls = 1);
    /// Without the stages that nothing was added to.
    std::vector<StageTime> list() const;

 private:
    mutable std::mutex mutex_;  // guards what follows
    std::vector<StageTime> stages_;
};

/// Adds the time from its making to its end to a stage. Without `times` it does not even look at the clock.
class TimedStage {
 public:
    TimedStage(StageTimes* times, const char* name) : times_(times), name_(name) {
        if (times_) begin_ = std::chrono::steady_clock::now();
    }
    ~TimedStage() {
        if (!times_) return;
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin_;
        times_->add(name_, passed.count());
    }
    TimedStage(const TimedStage&) = delete;
    TimedStage& operator=(const TimedStage&) = delete;

 private:
    StageTimes* times_;
    const char* name_;
    std::chrono::steady_clock::time_point begin_{};
};

}  // namespace hibi
