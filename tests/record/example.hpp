#pragma once
#include <filesystem>
#include <limits>
#include <string>

#include "record/files.hpp"
#include "record/run_folder.hpp"

namespace hibi::example {

/// Three particles in a row, two bonds, two bodies; values with many digits, so that a lost bit shows.
inline Topology topology() {
    Topology t;
    t.dimension = 2;
    t.thickness = 0.1;
    t.reference_position = {Vec3(0, 1.0 / 3, 0), Vec3(1, 1.0 / 3, 0), Vec3(2, 1.0 / 3, 0)};
    t.spacing = {1, 1, 1.0 / 7};
    t.body = {0, 0, 1};
    t.body_names = {"plate", "板"};
    t.first = {0, 1};
    t.second = {1, 2};
    t.rest_length = {1, 0.1};
    t.supports = {{"clamp", {0}, {true, true, false}}, {"", {}, {}}};
    t.loads = {{"tip, right", "force", {1, 2}, Vec3(0, -1, 0), true}};
    t.notches = {{Vec3(0, 0.1, 0), Vec3(0.2, 0.3, 0)}};
    return t;
}

/// The bond between the second and the third particle is broken from step 20 on, at 0.15 s.
inline Snapshot snapshot(std::int64_t step) {
    Snapshot s;
    s.step = step;
    s.time = static_cast<double>(step) / 100;
    const double u = s.time / 3;
    s.displacement = {Vec3::Zero(), Vec3(u, -u * 1e-9, 0), Vec3(2 * u, 1e-300, 0)};
    s.velocity = {Vec3::Zero(), Vec3(-1.0 / 3, 0, 0), Vec3(2.0 / 3, -0.0, 0)};
    s.bond_strain = {0, -0.1f, 1.0f / 3};
    s.damage = {0, 0.5f, 1};
    s.energy = {1e-20f, 2, 3e20f};
    s.stress = {{1, 2, 3, 4, 5, 6}, {-1, 0, 0, 0, 0, 0}, {0.1f, 0.2f, 0, 0, 0, 0}};
    if (step >= 20) {
        s.broken = {1};
        s.broken_at = {0.15};
    }
    return s;
}

inline HistoryRow row(double time) {
    HistoryRow r;
    r.time = time;
    r.load = 1e7 / 3;
    r.displacement = -0.1;
    r.kinetic = 1;
    r.elastic = 2;
    r.contact = 3;
    r.damped = 4;
    r.released = 5;
    r.work = 6;
    r.imbalance = 1e-300;
    r.broken = 7;
    r.momentum = Vec3(8, 9, 0);
    r.crack = {14, Vec3(1.0 / 3, 15, 0), 16};
    r.fragments = {17, 18, 19};
    r.loads = {10, 11};
    r.displacements = {12, 13};
    return r;
}

inline const std::vector<std::string> load_names = {"tip", "a \"b\", c"};

/// A run of four states at steps 0, 10, 20 and 30, ended properly.
inline void write_run(const std::filesystem::path& folder) {
    RunWriter writer(folder);
    writer.scene("version = 1\n");
    writer.topology(topology());
    writer.history_header(load_names, 2);
    for (const int step : {0, 10, 20, 30}) {
        if (step == 20) writer.breaks({{0.15, 1, 1, 2, Vec3(1.5, 1.0 / 3, 0), -0.1}});
        writer.row(row(step / 100.0));
        writer.state(snapshot(step));
    }
    RunSummary summary;
    summary.title = "Three in a row";
    summary.end_time = 0.3;
    writer.finish(summary);
}

/// The message of the std::runtime_error that `act` throws; empty where it throws none.
template <class Act>
std::string message_of(Act&& act) {
    try {
        act();
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

}  // namespace hibi::example
