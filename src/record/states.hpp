#pragma once
#include <filesystem>

#include "record/run_folder.hpp"
#include "results/snapshot.hpp"

namespace hibi {

/// Files of a run's states/ folder. Each is written under a temporary name and renamed; equal content gives
/// equal bytes. Errors: std::runtime_error naming the file.

/// states/topology.hdf: everything that stays the same, once.
void write_topology(const std::filesystem::path& states, const Topology& topology);
Topology read_topology(const std::filesystem::path& states);

/// states/<step>.hdf
std::filesystem::path state_file(const std::filesystem::path& states, std::int64_t step);

/// One state, an unstructured grid of VTK's HDF5 layout that ParaView opens: a point per particle, a line per
/// bond, broken or not. Group /Hibi holds what VTK has no place for. Bonds, bodies and other constant arrays
/// are links into topology.hdf.
void write_state(const std::filesystem::path& states, const Topology& topology, const Snapshot& snapshot);
/// Of the arrays with an entry per particle only those named, "displacement" say, the others being empty; all
/// where none is named.
Snapshot read_state(const std::filesystem::path& file, const Topology& topology,
                    const std::vector<std::string>& arrays = {});

/// Time and step of a state without its arrays.
StateInfo read_state_info(const std::filesystem::path& file);
RunReader::Extent read_extent(const std::filesystem::path& file);

}  // namespace hibi
