#pragma once
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "record/run_folder.hpp"
#include "scene/scene.hpp"

namespace hibi {

/// A cantilever as it might have been recorded, made from formulas: `columns` x `rows` particles 1 m apart,
/// clamped at the left, pushed down at the right; bonds between the first two columns break one after the
/// other from the top, the last one at `separation`; then the right part falls.
struct RecordedCantilever {
    int columns = 10, rows = 5;
    double end = 2, first_break = 1, separation = 1.5;  // (s)
    int states = 41;
    Vec3 corner = Vec3::Zero();  ///< the lower left one of the body (m)
    int flies = -1;  // a particle that loses all its bonds at 0.5 s and flies off to the right

    int particle(int i, int j) const { return j * columns + i; }

    Topology topology() const {
        Topology t;
        t.body_names = {"plate"};
        for (int j = 0; j < rows; ++j)
            for (int i = 0; i < columns; ++i) t.reference_position.push_back(corner + Vec3(i + 0.5, j + 0.5, 0));
        const int count = columns * rows;
        t.spacing.assign(count, 1.0);
        t.body.assign(count, 0);
        for (int a = 0; a < count; ++a)
            for (int b = a + 1; b < count; ++b) {
                const double length = (t.reference_position[b] - t.reference_position[a]).norm();
                if (length > 1.5) continue;  // sides and diagonals
                t.first.push_back(a);
                t.second.push_back(b);
                t.rest_length.push_back(length);
            }
        Support clamp{"clamp", {}, {true, true, false}};
        LoadMark tip{"tip", "force", {}, -Vec3::UnitY(), true};
        for (int j = 0; j < rows; ++j) {
            clamp.particles.push_back(particle(0, j));
            tip.particles.push_back(particle(columns - 1, j));
        }
        t.supports = {clamp};
        t.loads = {tip};
        return t;
    }

    /// Infinity, or the time at which a bond between the first two columns breaks: the higher, the earlier.
    double broken_at(const Topology& t, int bond) const {
        if (t.first[bond] == flies || t.second[bond] == flies) return 0.5;
        const Vec3 a = t.reference_position[t.first[bond]] - corner,
                   b = t.reference_position[t.second[bond]] - corner;
        if ((a.x() < 1) == (b.x() < 1)) return std::numeric_limits<double>::infinity();
        const double depth =
            (rows - 0.5 - std::max(a.y(), b.y())) / std::max(1, rows - 1);  // 0 at the top, 1 at the foot
        return first_break + (separation - first_break) * std::clamp(depth, 0.0, 1.0);
    }

    Snapshot snapshot(const Topology& t, int state) const {
        Snapshot s;
        s.time = end * state / (states - 1);
        s.step = state;
        const double fall = s.time > separation ? 20 * (s.time - separation) * (s.time - separation) : 0;
        for (const Vec3& place : t.reference_position) {
            const Vec3 X = place - corner;
            const double along = std::max(0.0, X.x() - 0.5) / columns,
                         load = std::min(s.time, separation) / separation;
            const double drop = 0.18 * columns * load * along * along, turn = 0.36 * load * along;
            const double height = X.y() - rows / 2.0;
            s.displacement.push_back({turn * height, -drop - (X.x() > 1 ? fall : 0.0), 0});
            s.velocity.push_back(Vec3::Zero());
            s.bond_strain.push_back(static_cast<float>(0.2 * load * (1 - along) * height / rows));
            s.damage.push_back(0);
            s.energy.push_back(static_cast<float>(height * height * load));
            s.stress.push_back({});
        }
        if (flies >= 0) s.displacement[flies].x() += 100 * std::max(0.0, s.time - 0.5);
        for (int b = 0; b < static_cast<int>(t.first.size()); ++b)
            if (broken_at(t, b) <= s.time) {
                s.broken.push_back(b);
                s.broken_at.push_back(broken_at(t, b));
            }
        return s;
    }

    Scene scene() const {
        Scene scene;
        scene.title = "Cantilever";
        scene.materials = {
            {.name = "concrete", .density = 2300, .youngs_modulus = 2.1e8, .poissons_ratio = 0.3}};
        scene.materials[0].break_strain = 0.1;
        scene.view.width = 320;
        scene.view.height = 180;
        scene.movie.duration = 2;
        scene.movie.fps = 10;
        scene.movie.hold = 0;
        return scene;
    }

    void write(const std::filesystem::path& folder) const {
        RunWriter writer(folder);
        const Topology t = topology();
        writer.topology(t);
        writer.history_header({"tip"}, 2);
        std::vector<Break> breaks;
        for (int b = 0; b < static_cast<int>(t.first.size()); ++b)
            if (std::isfinite(broken_at(t, b)))
                breaks.push_back({broken_at(t, b), b, t.first[b], t.second[b]});
        std::ranges::stable_sort(breaks, {}, &Break::time);
        for (int k = 0; k < states; ++k) {
            const Snapshot s = snapshot(t, k);
            HistoryRow row;
            row.time = s.time;
            row.load = s.time < separation ? 1e6 * s.time : 0;
            row.displacement = 0.18 * columns * s.time / separation;
            row.broken = static_cast<int>(s.broken.size());
            row.loads = {row.load};
            row.displacements = {row.displacement};
            writer.row(row);
            writer.state(s);
        }
        writer.breaks(breaks);
        RunSummary summary;
        summary.title = "Cantilever";
        summary.scene_hash = "0123abcd";
        summary.particles = columns * rows;
        summary.bonds = static_cast<int>(t.first.size());
        summary.end_time = summary.events.end = end;
        summary.events.first_break = Event{.time = first_break};
        summary.events.peak_load = Event{.time = 1.2};
        summary.events.separation = Event{.time = separation};
        writer.finish(summary);
    }
};

}  // namespace hibi
