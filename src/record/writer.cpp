#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <thread>

#include "record/files.hpp"
#include "record/leftovers.hpp"
#include "record/run_folder.hpp"
#include "record/states.hpp"
#include "record/tables.hpp"

namespace hibi {

namespace {

/// States waiting to be written may take this much memory; then state() waits for the disk.
constexpr std::size_t queue_bytes = std::size_t(256) << 20;

std::size_t bytes_of(const Snapshot& s) {
    constexpr std::size_t derived = sizeof(float) * (3 + 6);
    return s.displacement.size() * (2 * sizeof(Vec3) + derived) + s.angle.size() * sizeof(double) +
           s.broken.size() * (sizeof(int) + sizeof(double));
}

void create_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw std::runtime_error(
            fmt::format("{}: cannot create the folder: {}", folder.string(), error.message()));
}

/// A table that grows row by row.
class Growing {
 public:
    void open(const std::filesystem::path& file, const std::string& header) {
        file_ = file;
        stream_.open(file, std::ios::binary);
        add(header);
        flush();
    }
    void add(const std::string& line) { stream_ << line; }
    void flush() {
        stream_.flush();
        if (!stream_) throw std::runtime_error(fmt::format("{}: cannot write the file", file_.string()));
    }

 private:
    std::filesystem::path file_;
    std::ofstream stream_;
};

}  // namespace

struct RunWriter::Impl {
    struct Job {
        std::optional<Snapshot> write{};  ///< otherwise the state of `drop` goes
        std::int64_t drop = 0;
        std::size_t bytes = 0;
    };

    std::filesystem::path folder, states;
    std::string comment;
    StageTimes* profile = nullptr;
    Growing history, breaks;
    int dimension = 2;
    Topology topology;
    std::map<std::int64_t, double> recorded;  ///< step and time of the states there are, or will be

    std::mutex mutex;
    std::condition_variable changed;
    std::deque<Job> queue;
    std::size_t queued_bytes = 0;
    bool busy = false, closing = false;
    std::exception_ptr error;
    std::thread worker;

    /// In the worker: does the jobs in their order, so that a state is dropped after it was written.
    void work() {
        std::unique_lock lock(mutex);
        while (true) {
            changed.wait(lock, [&] { return !queue.empty() || closing; });
            if (queue.empty()) return;
            const Job job = std::move(queue.front());
            queue.pop_front();
            busy = true;
            lock.unlock();
            std::exception_ptr failure;
            try {
                if (job.write) {
                    const TimedStage timed(profile, "write states");
                    write_state(states, topology, *job.write);
                } else {
                    std::filesystem::remove(state_file(states, job.drop));
                }
            } catch (...) {
                failure = std::current_exception();
            }
            lock.lock();
            if (failure && !error) error = failure;
            busy = false;
            queued_bytes -= job.bytes;
            changed.notify_all();
        }
    }

    void rethrow() {
        const std::lock_guard lock(mutex);
        if (error) std::rethrow_exception(error);
    }

    void add(Job job) {
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return queued_bytes < queue_bytes || error; });
        if (error) std::rethrow_exception(error);
        queued_bytes += job.bytes;
        queue.push_back(std::move(job));
        changed.notify_all();
    }

    /// True where the state of this step was still waiting to be written, and waits no longer.
    bool cancel(std::int64_t step) {
        const std::lock_guard lock(mutex);
        const auto job = std::ranges::find_if(
            queue, [&](const Job& waiting) { return waiting.write && waiting.write->step == step; });
        if (job == queue.end()) return false;
        queued_bytes -= job->bytes;
        queue.erase(job);
        return true;
    }

    void drain() {
        std::unique_lock lock(mutex);
        changed.wait(lock, [&] { return queue.empty() && !busy; });
        if (error) std::rethrow_exception(error);
    }

    /// The list with which ParaView knows the times: it ignores those inside the files.
    void write_series() const {
        nlohmann::ordered_json files = nlohmann::ordered_json::array();
        for (const auto& [step, time] : recorded) {
            const std::filesystem::path file = state_file(states.filename(), step);
            files.push_back({{"name", file.generic_string()}, {"time", time}});
        }
        const nlohmann::ordered_json series = {{"file-series-version", "1.0"}, {"files", files}};
        write_file(folder / "states.hdf.series", series.dump(1) + "\n");
    }
};

RunWriter::RunWriter(std::filesystem::path folder, std::string comment, StageTimes* profile)
    : impl_(std::make_unique<Impl>()) {
    impl_->comment = std::move(comment);
    impl_->profile = profile;
    impl_->folder = std::move(folder);
    impl_->states = impl_->folder / "states";
    create_folder(impl_->folder);
    // Before anything is removed: a folder that cannot be written keeps its old run.
    write_file(impl_->folder / "scene.toml", "");
    remove_leftovers(impl_->folder);
    create_folder(impl_->states);
    impl_->worker = std::thread([impl = impl_.get()] { impl->work(); });
}

/// Also when a run fails: everything recorded so far is kept.
RunWriter::~RunWriter() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->closing = true;
    }
    impl_->changed.notify_all();
    impl_->worker.join();
}

void RunWriter::scene(const std::string& toml) { write_file(impl_->folder / "scene.toml", toml); }

void RunWriter::topology(Topology topology) {
    write_topology(impl_->states, topology);
    impl_->topology = std::move(topology);
}

void RunWriter::history_header(const std::vector<std::string>& load_names, int dimension) {
    impl_->dimension = dimension;
    impl_->history.open(impl_->folder / "history.csv",
                        hibi::history_header(load_names, dimension, impl_->comment));
    impl_->breaks.open(impl_->folder / "breaks.csv", breaks_header(dimension, impl_->comment));
}

void RunWriter::row(const HistoryRow& row) {
    impl_->rethrow();
    impl_->history.add(history_line(row, impl_->dimension));
}

void RunWriter::breaks(const std::vector<Break>& breaks) {
    impl_->rethrow();
    for (const Break& b : breaks) impl_->breaks.add(break_line(b, impl_->dimension));
    impl_->breaks.flush();
}

void RunWriter::state(Snapshot snapshot) {
    impl_->rethrow();
    if (!impl_->recorded.emplace(snapshot.step, snapshot.time).second) return;
    impl_->history.flush();  // a killed run then has the history that belongs to its states
    const std::size_t bytes = bytes_of(snapshot);
    impl_->add({.write = std::move(snapshot), .bytes = bytes});
}

void RunWriter::drop_state(std::int64_t step) {
    if (impl_->recorded.erase(step) == 0 || impl_->cancel(step)) return;
    impl_->add({.drop = step});
}

void RunWriter::drain() { impl_->drain(); }

void RunWriter::finish(const RunSummary& summary) {
    drain();
    impl_->history.flush();
    impl_->breaks.flush();
    impl_->write_series();
    write_summary(impl_->folder, summary);
}

}  // namespace hibi
