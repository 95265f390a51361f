#include "record/states.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "record/files.hpp"
#include "record/hdf.hpp"

namespace hibi {

namespace {

constexpr const char* point_data = "/VTKHDF/PointData/";
constexpr const char* topology_file = "topology.hdf";

/// In single precision: for pictures. Displacements have all digits.
using Point = std::array<float, 3>;
std::vector<Point> positions(const Topology& topology, const Snapshot& snapshot) {
    std::vector<Point> points;
    points.reserve(snapshot.displacement.size());
    for (int i = 0; i < snapshot.count(); ++i) {
        const Vec3 x = topology.reference_position[i] + snapshot.displacement[i];
        points.push_back({static_cast<float>(x.x()), static_cast<float>(x.y()), static_cast<float>(x.z())});
    }
    return points;
}

void write_grid(HdfFile& file, const Topology& topology, const Snapshot& snapshot) {
    const auto bonds = static_cast<std::int64_t>(topology.first.size());
    file.group("/VTKHDF");
    file.attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
    file.attribute("/VTKHDF", "Type", std::string("UnstructuredGrid"));
    file.write("/VTKHDF/NumberOfPoints", std::vector<std::int64_t>{snapshot.count()});
    file.write("/VTKHDF/NumberOfCells", std::vector<std::int64_t>{bonds});
    file.write("/VTKHDF/NumberOfConnectivityIds", std::vector<std::int64_t>{2 * bonds});
    for (const char* name : {"/VTKHDF/Connectivity", "/VTKHDF/Offsets", "/VTKHDF/Types"})
        file.link(name, topology_file, name);
    file.write("/VTKHDF/Points", positions(topology, snapshot));

    std::vector<std::uint8_t> broken(bonds, 0);
    for (const int bond : snapshot.broken) broken[bond] = 1;
    file.group("/VTKHDF/CellData");
    file.write("/VTKHDF/CellData/broken", broken);
}

/// Walks the arrays of a snapshot that have an entry per particle, with the names ParaView shows.
template <class Some, class Visit>
void each_point_array(Some& snapshot, Visit&& visit) {
    visit("displacement", snapshot.displacement);
    visit("velocity", snapshot.velocity);
    visit("bond_strain", snapshot.bond_strain);
    visit("damage", snapshot.damage);
    visit("energy", snapshot.energy);
    visit("stress", snapshot.stress);
}

/// Smallest and largest; what is no number does not count. In lanes, or each number would wait for the last.
std::array<float, 2> range_of(const std::vector<float>& values) {
    constexpr std::size_t lanes = 16;
    constexpr float infinity = std::numeric_limits<float>::infinity();
    std::array<float, lanes> low, high;
    low.fill(infinity);
    high.fill(-infinity);
    const auto look = [&](std::size_t lane, float value) {
        low[lane] = value < low[lane] ? value : low[lane];
        high[lane] = value > high[lane] ? value : high[lane];
    };
    std::size_t i = 0;
    for (; i + lanes <= values.size(); i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane) look(lane, values[i + lane]);
    for (; i < values.size(); ++i) look(0, values[i]);
    return {*std::ranges::min_element(low), *std::ranges::max_element(high)};
}

void write_extent(HdfFile& file, const Topology& topology, const Snapshot& snapshot) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Vec3 low = Vec3::Constant(infinity), high = -low;
    for (int i = 0; i < snapshot.count(); ++i) {
        const Vec3 x = topology.reference_position[i] + snapshot.displacement[i];
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    file.attribute("/Hibi", "low", std::vector<Vec3>{low});
    file.attribute("/Hibi", "high", std::vector<Vec3>{high});
    file.group("/Hibi/range");
    for (const std::string& name : scalar_field_names())
        file.attribute("/Hibi/range", name, std::vector{range_of(scalar_field(topology, snapshot, name))});
}

}  // namespace

std::filesystem::path state_file(const std::filesystem::path& states, std::int64_t step) {
    return states / fmt::format("{:06}.hdf", step);
}

void write_state(const std::filesystem::path& states, const Topology& topology, const Snapshot& snapshot) {
    assert(topology.reference_position.size() == snapshot.displacement.size());
    const std::filesystem::path path = state_file(states, snapshot.step);
    HdfFile file = HdfFile::create(part_of(path));
    write_grid(file, topology, snapshot);
    file.group("/VTKHDF/PointData");
    each_point_array(snapshot, [&](const char* name, const auto& data) {
        file.write(point_data + std::string(name), data);
    });
    if (!snapshot.angle.empty()) file.write(point_data + std::string("angle"), snapshot.angle);
    file.link(point_data + std::string("body"), topology_file, "/Hibi/body");
    file.link(point_data + std::string("spacing"), topology_file, "/Hibi/spacing");

    file.group("/Hibi");
    file.attribute("/Hibi", "time", std::vector<double>{snapshot.time});
    file.attribute("/Hibi", "step", std::vector<std::int64_t>{snapshot.step});
    file.write("/Hibi/broken", snapshot.broken);
    file.write("/Hibi/broken_at", snapshot.broken_at);
    write_extent(file, topology, snapshot);
    file.close();
    rename_part(path);
}

Snapshot read_state(const std::filesystem::path& path, const Topology& topology,
                    const std::vector<std::string>& arrays) {
    const HdfFile file = HdfFile::open(path);
    const auto particles = static_cast<std::int64_t>(topology.reference_position.size());
    const auto bonds = static_cast<int>(topology.first.size());
    Snapshot s;
    s.time = file.attribute<double>("/Hibi", "time", 1).front();
    s.step = file.attribute<std::int64_t>("/Hibi", "step", 1).front();
    each_point_array(s, [&](const char* name, auto& data) {
        using Entry = typename std::decay_t<decltype(data)>::value_type;
        if (!arrays.empty() && std::ranges::find(arrays, name) == arrays.end()) return;
        data = file.read<Entry>(point_data + std::string(name), particles);
    });
    const std::string angle = point_data + std::string("angle");
    if (arrays.empty() && file.has(angle)) s.angle = file.read<double>(angle, particles);
    s.broken = file.read<int>("/Hibi/broken");
    s.broken_at = file.read<double>("/Hibi/broken_at", static_cast<std::int64_t>(s.broken.size()));
    for (const int bond : s.broken)
        if (bond < 0 || bond >= bonds)
            file.fail(fmt::format("/Hibi/broken names bond {}, but the run has {} bonds", bond, bonds));
    return s;
}

StateInfo read_state_info(const std::filesystem::path& path) {
    const HdfFile file = HdfFile::open(path);
    return {file.attribute<double>("/Hibi", "time", 1).front(),
            file.attribute<std::int64_t>("/Hibi", "step", 1).front(), path};
}

RunReader::Extent read_extent(const std::filesystem::path& path) {
    const HdfFile file = HdfFile::open(path);
    RunReader::Extent extent;
    extent.low = file.attribute<Vec3>("/Hibi", "low", 1).front();
    extent.high = file.attribute<Vec3>("/Hibi", "high", 1).front();
    for (const std::string& name : scalar_field_names())
        extent.range[name] = file.attribute<std::array<float, 2>>("/Hibi/range", name, 1).front();
    return extent;
}

}  // namespace hibi
