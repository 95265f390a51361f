#pragma once
#include <any>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/stage_time.hpp"
#include "results/history.hpp"
#include "results/moment.hpp"
#include "results/snapshot.hpp"

namespace hibi {

/// The numbers of run.json; key names are a contract with scripts: add freely, rename never.
struct RunSummary {
    std::string title, scene_hash, scene_file, version;
    std::map<std::string, std::string> parameters;  ///< what -p said, as it was written
    std::string command;                            ///< that made the run, ready for a shell
    int particles = 0, bonds = 0, broken = 0, frames = 0, threads = 0;
    int fps = 0;        ///< of the film; 0 where none is drawn
    int dimension = 2;  ///< components of a position in run.json
    std::int64_t steps = 0;
    double time_step = 0, end_time = 0;
    Events events;
    CrackReading crack{};        ///< at the end
    double top_crack_speed = 0;  ///< over the run (m/s)
    Fragments fragments{};       ///< at the end
    double worst_imbalance = 0, imbalance_at_first_break = 0;
    bool trusted = true;
    /// What `--profile` measured, stage by stage: "run", "draw". Stages of different threads overlap.
    std::map<std::string, std::vector<StageTime>> profile;
    std::map<std::string, double> seconds;  ///< setup, solve, draw, encode, total
    std::optional<std::string> stopped;     ///< why the run ended early, in words
    std::vector<std::string> warnings;
};

/// Writes the folder of a run while it goes on. Every file is written under a temporary name and renamed, but
/// history.csv and breaks.csv, which grow. States are written by a thread of its own; its errors are thrown
/// by the next call. The state of step n is states/<n, six digits or more>.hdf; the topology, which all
/// states share by HDF5 external links, is states/topology.hdf.
class RunWriter {
 public:
    /// Creates the folder; removes what an earlier run left in it, and nothing else.
    /// Throws std::runtime_error naming the folder where it cannot be written.
    /// `comment` stands behind the units in the tables.
    /// `profile` takes the time of its thread.
    explicit RunWriter(std::filesystem::path folder, std::string comment = {}, StageTimes* profile = nullptr);
    ~RunWriter();
    RunWriter(const RunWriter&) = delete;
    RunWriter& operator=(const RunWriter&) = delete;

    void scene(const std::string& toml);
    void topology(Topology topology);  ///< before the first state
    void history_header(const std::vector<std::string>& load_names, int dimension);
    void row(const HistoryRow& row);
    void breaks(const std::vector<Break>& breaks);
    void state(Snapshot snapshot);       ///< queued; ignored if that step is already there
    void drop_state(std::int64_t step);  ///< a state no longer wanted
    /// Waits until every state handed over stands on the disk.
    void drain();
    /// Waits for the queue, writes states.hdf.series and run.json. May fail, so it is no destructor.
    void finish(const RunSummary& summary);

 private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// Rewrites DIR/run.json (after drawing, say).
void write_summary(const std::filesystem::path& folder, const RunSummary& summary);

/// One entry of frames.json.
struct FrameInfo {
    std::string file;                    ///< relative to the folder: frames/000000.png
    double time = 0;                     ///< simulated time (s)
    std::optional<std::string> event{};  ///< the most telling event of this frame
    std::vector<std::string> events{};   ///< all of them
    int broken = 0;                      ///< bonds drawn as broken
    std::string sha256;                  ///< pixel_hash of the frame
};
void write_frames(const std::filesystem::path& folder, const std::vector<FrameInfo>& frames);
/// Empty where there is no frames.json. Throws std::runtime_error for one that is damaged.
std::vector<FrameInfo> read_frames(const std::filesystem::path& folder);

struct StateInfo {
    double time = 0;
    std::int64_t step = 0;
    std::filesystem::path file;
};

/// What drawing needs of a recorded run. Small parts are read at once, states one by one.
/// Every error names the file and what is wrong with it (std::runtime_error). A run that was killed can be
/// read as well: without run.json the summary says so in `stopped` and counts what the other files hold.
class RunReader {
 public:
    explicit RunReader(std::filesystem::path folder);

    const std::filesystem::path& folder() const { return folder_; }
    const Topology& topology() const { return topology_; }
    const History& history() const { return history_; }
    const std::vector<StateInfo>& states() const { return states_; }  ///< in rising order of time
    const std::vector<double>& broken_at() const {
        return broken_at_;
    }  ///< per bond (s), infinity where intact
    const RunSummary& summary() const { return summary_; }
    /// Of the arrays with an entry per particle only those named, the others being empty; all where none is
    /// named. May be called from any thread.
    Snapshot read(int state, const std::vector<std::string>& arrays = {}) const;

    /// Extent of one state without reading all of it: smallest and largest position and, by field name of
    /// scalar_field, smallest and largest value. Stored with the state when it was written.
    struct Extent {
        Vec3 low, high;
        std::map<std::string, std::array<float, 2>> range;
    };
    Extent extent(int state) const;

    /// What `make` makes of the run, kept under `name` as long as the reader: one run is drawn in many
    /// styles, and need not be read through for each. One name has one type. Not thread-safe.
    template <class T, class Make>
    const T& once(const std::string& name, Make&& make) const {
        const auto found = made_.find(name);
        if (found != made_.end()) return *std::any_cast<T>(&found->second);
        std::any made = T(make());
        return *std::any_cast<T>(&made_.emplace(name, std::move(made)).first->second);
    }

 private:
    std::filesystem::path folder_;
    Topology topology_;
    History history_;
    std::vector<StateInfo> states_;
    std::vector<double> broken_at_;
    RunSummary summary_;
    mutable std::map<std::string, std::any> made_;
};

}  // namespace hibi
