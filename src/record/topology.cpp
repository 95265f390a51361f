#include <fmt/format.h>

#include "record/files.hpp"
#include "record/hdf.hpp"
#include "record/states.hpp"

namespace hibi {

namespace {

constexpr std::uint8_t vtk_line = 3;

std::vector<std::uint8_t> flags(const std::array<bool, 3>& axes) { return {axes[0], axes[1], axes[2]}; }

/// The arrays with which VTK describes the bonds: a line of two points each.
void write_cells(HdfFile& file, const Topology& topology) {
    const std::size_t bonds = topology.first.size();
    std::vector<std::int64_t> connectivity, offsets = {0};
    for (std::size_t b = 0; b < bonds; ++b) {
        connectivity.insert(connectivity.end(), {topology.first[b], topology.second[b]});
        offsets.push_back(offsets.back() + 2);
    }
    file.group("/VTKHDF");
    file.write("/VTKHDF/Connectivity", connectivity);
    file.write("/VTKHDF/Offsets", offsets);
    file.write("/VTKHDF/Types", std::vector<std::uint8_t>(bonds, vtk_line));
}

void write_names(HdfFile& file, const Topology& topology) {
    file.attribute("/Hibi", "bodies", std::vector<int>{static_cast<int>(topology.body_names.size())});
    for (std::size_t i = 0; i < topology.body_names.size(); ++i)
        file.attribute("/Hibi", fmt::format("body {}", i), topology.body_names[i]);
}

void write_supports_and_loads(HdfFile& file, const Topology& topology) {
    file.group("/Hibi/supports");
    for (std::size_t i = 0; i < topology.supports.size(); ++i) {
        const Support& support = topology.supports[i];
        const std::string group = fmt::format("/Hibi/supports/{}", i);
        file.group(group);
        file.attribute(group, "name", support.name);
        file.attribute(group, "axes", flags(support.axes));
        file.write(group + "/particles", support.particles);
    }
    file.group("/Hibi/loads");
    for (std::size_t i = 0; i < topology.loads.size(); ++i) {
        const LoadMark& load = topology.loads[i];
        const std::string group = fmt::format("/Hibi/loads/{}", i);
        file.group(group);
        file.attribute(group, "name", load.name);
        file.attribute(group, "kind", load.kind);
        file.attribute(group, "direction", std::vector<Vec3>{load.direction});
        file.attribute(group, "primary", std::vector<std::uint8_t>{load.primary});
        file.write(group + "/particles", load.particles);
    }
}

/// Throws unless every entry is an index below `count`: a damaged file must not make us read elsewhere.
void check_indices(const HdfFile& file, const std::string& name, const std::vector<int>& indices,
                   std::size_t count) {
    for (const int index : indices)
        if (index < 0 || static_cast<std::size_t>(index) >= count)
            file.fail(fmt::format("{} holds the index {}, expected 0 .. {}", name, index, count - 1));
}

void read_supports_and_loads(const HdfFile& file, Topology& topology) {
    for (int i = 0; file.has(fmt::format("/Hibi/supports/{}", i)); ++i) {
        const std::string group = fmt::format("/Hibi/supports/{}", i);
        Support support;
        support.name = file.text_attribute(group, "name");
        const auto axes = file.attribute<std::uint8_t>(group, "axes", 3);
        for (int a = 0; a < 3; ++a) support.axes[a] = axes[a] != 0;
        support.particles = file.read<int>(group + "/particles");
        check_indices(file, group, support.particles, topology.reference_position.size());
        topology.supports.push_back(support);
    }
    for (int i = 0; file.has(fmt::format("/Hibi/loads/{}", i)); ++i) {
        const std::string group = fmt::format("/Hibi/loads/{}", i);
        LoadMark load;
        load.name = file.text_attribute(group, "name");
        load.kind = file.text_attribute(group, "kind");
        load.direction = file.attribute<Vec3>(group, "direction", 1).front();
        load.primary = file.attribute<std::uint8_t>(group, "primary", 1).front() != 0;
        load.particles = file.read<int>(group + "/particles");
        check_indices(file, group, load.particles, topology.reference_position.size());
        topology.loads.push_back(load);
    }
}

}  // namespace

void write_topology(const std::filesystem::path& states, const Topology& topology) {
    const std::filesystem::path path = states / "topology.hdf";
    HdfFile file = HdfFile::create(part_of(path));
    write_cells(file, topology);
    file.group("/Hibi");
    file.attribute("/Hibi", "dimension", std::vector<int>{topology.dimension});
    file.attribute("/Hibi", "thickness", std::vector<double>{topology.thickness});
    file.write("/Hibi/reference_position", topology.reference_position);
    file.write("/Hibi/spacing", topology.spacing);
    file.write("/Hibi/body", topology.body);
    file.write("/Hibi/first", topology.first);
    file.write("/Hibi/second", topology.second);
    file.write("/Hibi/rest_length", topology.rest_length);
    file.write("/Hibi/notches", topology.notches);
    write_names(file, topology);
    write_supports_and_loads(file, topology);
    file.close();
    rename_part(path);
}

Topology read_topology(const std::filesystem::path& states) {
    const HdfFile file = HdfFile::open(states / "topology.hdf");
    Topology t;
    t.dimension = file.attribute<int>("/Hibi", "dimension", 1).front();
    t.thickness = file.attribute<double>("/Hibi", "thickness", 1).front();
    t.reference_position = file.read<Vec3>("/Hibi/reference_position");
    const auto particles = static_cast<std::int64_t>(t.reference_position.size());
    t.spacing = file.read<double>("/Hibi/spacing", particles);
    t.body = file.read<int>("/Hibi/body", particles);
    t.first = file.read<int>("/Hibi/first");
    const auto bonds = static_cast<std::int64_t>(t.first.size());
    t.second = file.read<int>("/Hibi/second", bonds);
    t.rest_length = file.read<double>("/Hibi/rest_length", bonds);
    t.notches = file.read<std::array<Vec3, 2>>("/Hibi/notches");
    const int bodies = file.attribute<int>("/Hibi", "bodies", 1).front();
    for (int i = 0; i < bodies; ++i)
        t.body_names.push_back(file.text_attribute("/Hibi", fmt::format("body {}", i)));
    check_indices(file, "/Hibi/first", t.first, t.reference_position.size());
    check_indices(file, "/Hibi/second", t.second, t.reference_position.size());
    check_indices(file, "/Hibi/body", t.body, t.body_names.size());
    read_supports_and_loads(file, t);
    return t;
}

}  // namespace hibi
