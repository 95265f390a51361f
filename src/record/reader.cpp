#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <stdexcept>

#include "record/run_folder.hpp"
#include "record/states.hpp"
#include "record/summary.hpp"
#include "record/tables.hpp"

namespace hibi {

namespace {

/// By the times in the files themselves: a killed run has no list of them.
std::vector<StateInfo> find_states(const std::filesystem::path& folder) {
    std::vector<StateInfo> states;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".hdf" && entry.path().filename() != "topology.hdf")
            states.push_back(read_state_info(entry.path()));
    std::ranges::sort(states, {}, [](const StateInfo& s) { return std::pair(s.time, s.step); });
    return states;
}

std::vector<double> break_times(const std::filesystem::path& file, int bonds) {
    std::vector<double> broken_at(bonds, std::numeric_limits<double>::infinity());
    for (const Break& b : read_breaks(file)) {
        if (b.bond < 0 || b.bond >= bonds)
            throw std::runtime_error(
                fmt::format("{}: names bond {}, but the run has {} bonds", file.string(), b.bond, bonds));
        broken_at[b.bond] = b.time;
    }
    return broken_at;
}

}  // namespace

RunReader::RunReader(std::filesystem::path folder) : folder_(std::move(folder)) {
    const std::filesystem::path states = folder_ / "states";
    if (!std::filesystem::is_directory(folder_))
        throw std::runtime_error(fmt::format("{}: there is no such folder", folder_.string()));
    if (!std::filesystem::exists(states / "topology.hdf"))
        throw std::runtime_error(
            fmt::format("{}: holds no recorded run: states/topology.hdf is missing", folder_.string()));
    topology_ = read_topology(states);
    states_ = find_states(states);
    if (states_.empty())
        throw std::runtime_error(fmt::format("{}: holds no state of the run", states.string()));
    history_ = read_history(folder_ / "history.csv");
    const int bonds = static_cast<int>(topology_.first.size());
    broken_at_ = break_times(folder_ / "breaks.csv", bonds);

    // A run that is killed leaves the run.json it began with, which counts no steps.
    if (std::filesystem::exists(folder_ / "run.json")) summary_ = read_summary(folder_);
    if (summary_.steps > 0) return;
    summary_.particles = static_cast<int>(topology_.reference_position.size());
    summary_.bonds = bonds;
    summary_.broken = static_cast<int>(std::ranges::count_if(
        broken_at_, [](double time) { return time < std::numeric_limits<double>::infinity(); }));
    summary_.dimension = topology_.dimension;
    summary_.steps = states_.back().step;
    summary_.end_time = summary_.events.end = states_.back().time;
    summary_.trusted = false;
    summary_.stopped = "the run did not come to its end";
    const std::vector<Break> breaks = read_breaks(folder_ / "breaks.csv");
    if (!breaks.empty()) summary_.events.first_break = Event{.time = breaks.front().time};
}

Snapshot RunReader::read(int state, const std::vector<std::string>& arrays) const {
    static std::mutex one_at_a_time;  // not every HDF5 can do more
    const std::lock_guard lock(one_at_a_time);
    return read_state(states_.at(state).file, topology_, arrays);
}

RunReader::Extent RunReader::extent(int state) const { return read_extent(states_.at(state).file); }

}  // namespace hibi
