#include "record/hdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "record/planes.hpp"

namespace hibi {

namespace {

/// Numbers in a chunk: large enough to compress well, small enough for HDF5's cache of 1 MB.
constexpr std::size_t chunk_rows = 1 << 16;
/// Below this many numbers the index of the chunks is larger than what compression saves.
constexpr std::size_t chunk_minimum = 512;

/// HDF5's innermost reason for the last failure of this thread.
std::string last_error() {
    std::string reason;
    const auto first = [](unsigned, const H5E_error2_t* error, void* text) -> herr_t {
        auto& its_text = *static_cast<std::string*>(text);
        if (its_text.empty()) its_text = error->desc;
        return 0;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, first, &reason);
    H5Eclear2(H5E_DEFAULT);  // or it is lost with the thread
    return reason;
}

/// Without this HDF5 prints its stack of errors to standard error; the setting belongs to the thread.
void keep_quiet() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

/// Rows of a chunk where chunks are as HdfFile::write makes them, a column each, of numbers of this type;
/// else 0: files of earlier versions have chunks of whole rows.
std::size_t column_chunk(hid_t dataset, hid_t type) {
    const HdfHandle layout(H5Dget_create_plist(dataset), H5Pclose), stored(H5Dget_type(dataset), H5Tclose);
    std::array<hsize_t, 2> chunk{};
    const bool columns = H5Pget_layout(layout) == H5D_CHUNKED && H5Pget_nfilters(layout) == 2 &&
                         H5Pget_chunk(layout, 2, chunk.data()) == 2 && chunk[1] == 1 &&
                         H5Tequal(stored, type) > 0;
    return columns ? chunk[0] : 0;
}

/// Are these numbers, so many bytes apart, zeros bit for bit?
template <class Bits>
bool all_zero(const std::uint8_t* numbers, std::size_t stride, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
        Bits bits;
        std::memcpy(&bits, numbers + i * stride, sizeof bits);
        if (bits != 0) return false;
    }
    return true;
}
bool all_zero(const std::uint8_t* numbers, std::size_t stride, std::size_t count, std::size_t size) {
    if (size == 8) return all_zero<std::uint64_t>(numbers, stride, count);
    if (size == 4) return all_zero<std::uint32_t>(numbers, stride, count);
    return all_zero<std::uint8_t>(numbers, stride, count);
}

HdfHandle properties(hid_t kind) { return {H5Pcreate(kind), H5Pclose}; }

}  // namespace

void HdfFile::fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", file_.string(), what));
}

void HdfFile::check(bool good, const std::string& operation) const {
    if (good) return;
    const std::string reason = last_error();
    fail(fmt::format("cannot {}{}", operation, reason.empty() ? "" : " (" + reason + ")"));
}

HdfFile HdfFile::create(const std::filesystem::path& file) {
    keep_quiet();
    HdfFile made(file, {H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose});
    made.check(made.handle_.valid(), "create the file");
    return made;
}

HdfFile HdfFile::open(const std::filesystem::path& file) {
    keep_quiet();
    HdfFile opened(file, {H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose});
    opened.check(opened.handle_.valid(), "open the file, it may be damaged or incomplete");
    return opened;
}

void HdfFile::group(const std::string& name) {
    const HdfHandle made(H5Gcreate2(handle_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
    check(made.valid(), "create group " + name);
}

void HdfFile::write(const std::string& name, hid_t type, std::size_t width, std::size_t rows,
                    const void* data) {
    const int rank = width == 1 ? 1 : 2;
    const std::array<hsize_t, 2> size = {rows, width};
    // A column each: where one holds nothing but zeros, as z does in the plane, it costs nothing.
    const std::array<hsize_t, 2> chunk = {std::min(rows, chunk_rows), 1};
    const bool chunked = rows * width >= chunk_minimum;
    const HdfHandle layout = properties(H5P_DATASET_CREATE);
    bool good = H5Pset_obj_track_times(layout, false) >= 0;
    if (chunked)
        good = good && H5Pset_chunk(layout, rank, chunk.data()) >= 0 && H5Pset_shuffle(layout) >= 0 &&
               H5Pset_deflate(layout, 1) >= 0;
    const HdfHandle space(H5Screate_simple(rank, size.data(), nullptr), H5Sclose);
    HdfHandle dataset(H5Dcreate2(handle_, name.c_str(), type, space, H5P_DEFAULT, layout, H5P_DEFAULT),
                      H5Dclose);
    good = good && dataset.valid();
    if (chunked)
        good = good && write_chunks(dataset, H5Tget_size(type), width, rows, chunk[0], data);
    else if (rows > 0)
        good = good && H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
    check(good, "write " + name);
    check(dataset.close(), "write " + name);
}

/// Past HDF5's own filters, which read what is written here.
bool HdfFile::write_chunks(hid_t dataset, std::size_t number_size, std::size_t width, std::size_t rows,
                           std::size_t chunk_size, const void* data) {
    const auto* bytes = static_cast<const std::uint8_t*>(data);
    const std::size_t stride = width * number_size;
    PlaneDeflater deflater;
    for (std::size_t row = 0; row < rows; row += chunk_size)
        for (std::size_t c = 0; c < width; ++c) {
            const std::uint8_t* numbers = bytes + row * stride + c * number_size;
            const std::size_t count = std::min(chunk_size, rows - row);
            // A chunk that is not there reads as zeros.
            if (all_zero(numbers, stride, count, number_size)) continue;
            const auto deflated = deflater.deflate(numbers, stride, count, number_size, chunk_size);
            const std::array<hsize_t, 2> place = {row, c};
            if (H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, place.data(), deflated.size(), deflated.data()) < 0)
                return false;
        }
    return true;
}

void HdfFile::write_attribute(const std::string& object, const std::string& name, hid_t type,
                              std::size_t count, const void* data) {
    const hsize_t size = count;
    const HdfHandle space(H5Screate_simple(1, &size, nullptr), H5Sclose);
    const HdfHandle made(H5Acreate_by_name(handle_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                           H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
    check(made.valid() && H5Awrite(made, type, data) >= 0, fmt::format("write {}:{}", object, name));
}

void HdfFile::attribute(const std::string& object, const std::string& name, const std::string& text) {
    const bool ascii = std::ranges::all_of(text, [](unsigned char c) { return c < 128; });
    const HdfHandle type(H5Tcopy(H5T_C_S1), H5Tclose);
    const std::size_t size = std::max<std::size_t>(1, text.size());  // HDF5 knows no string of length 0
    H5Tset_size(type, size);
    H5Tset_strpad(type, H5T_STR_NULLPAD);
    H5Tset_cset(type, ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
    const HdfHandle space(H5Screate(H5S_SCALAR), H5Sclose);
    const HdfHandle made(H5Acreate_by_name(handle_, object.c_str(), name.c_str(), type, space, H5P_DEFAULT,
                                           H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
    check(made.valid() && H5Awrite(made, type, text.c_str()) >= 0, fmt::format("write {}:{}", object, name));
}

void HdfFile::link(const std::string& name, const std::string& file, const std::string& target) {
    check(H5Lcreate_external(file.c_str(), target.c_str(), handle_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT) >=
              0,
          "link " + name);
}

void HdfFile::close() { check(handle_.close(), "finish the file"); }

bool HdfFile::has(const std::string& name) const { return H5Lexists(handle_, name.c_str(), H5P_DEFAULT) > 0; }

HdfHandle HdfFile::open_dataset(const std::string& name) const {
    HdfHandle dataset(H5Dopen2(handle_, name.c_str(), H5P_DEFAULT), H5Dclose);
    check(dataset.valid(), "find " + name);
    return dataset;
}

std::size_t HdfFile::check_rows(hid_t dataset, const std::string& name, std::size_t width,
                                std::int64_t rows) const {
    const HdfHandle space(H5Dget_space(dataset), H5Sclose);
    std::array<hsize_t, 2> size = {0, 1};
    const int rank = H5Sget_simple_extent_ndims(space);
    if (rank < 1 || rank > 2) fail(name + " is no table");
    H5Sget_simple_extent_dims(space, size.data(), nullptr);
    if (size[1] != width || (rows >= 0 && size[0] != static_cast<hsize_t>(rows)))
        fail(fmt::format("{} holds {} x {} numbers, expected {} x {}", name, size[0], size[1],
                         rows >= 0 ? std::to_string(rows) : "any number of", width));
    return size[0];
}

void HdfFile::read_dataset(hid_t dataset, const std::string& name, hid_t type, std::size_t width,
                           std::size_t rows, void* data) const {
    const std::size_t chunk_size = width > 1 ? column_chunk(dataset, type) : 0;
    const bool good = chunk_size > 0 ? read_columns(dataset, H5Tget_size(type), width, rows, chunk_size, data)
                                     : H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data) >= 0;
    check(good, "read " + name);
}

/// Past HDF5's own filters: it is slow where it has to put every number of a chunk in a place of its own.
bool HdfFile::read_columns(hid_t dataset, std::size_t number_size, std::size_t width, std::size_t rows,
                           std::size_t chunk_size, void* data) {
    auto* bytes = static_cast<std::uint8_t*>(data);
    const std::size_t stride = width * number_size;
    std::vector<std::uint8_t> deflated, planes(chunk_size * number_size);
    for (std::size_t row = 0; row < rows; row += chunk_size)
        for (std::size_t c = 0; c < width; ++c) {
            const std::array<hsize_t, 2> place = {row, c};
            hsize_t size = 0;
            unsigned unused_filters = 0;
            haddr_t address = 0;
            if (H5Dget_chunk_info_by_coord(dataset, place.data(), &unused_filters, &address, &size) < 0)
                return false;
            std::uint8_t* numbers = bytes + row * stride + c * number_size;
            const std::size_t count = std::min(chunk_size, rows - row);
            if (size == 0) {  // all zeros
                for (std::size_t i = 0; i < count; ++i) std::memset(numbers + i * stride, 0, number_size);
                continue;
            }
            deflated.resize(size);
            if (H5Dread_chunk(dataset, H5P_DEFAULT, place.data(), &unused_filters, deflated.data()) < 0 ||
                unused_filters != 0 || !inflate_planes(deflated, planes, numbers, stride, count, number_size))
                return false;
        }
    return true;
}

HdfHandle HdfFile::open_attribute(const std::string& object, const std::string& name) const {
    HdfHandle found(H5Aopen_by_name(handle_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                    H5Aclose);
    check(found.valid(), fmt::format("find {}:{}", object, name));
    return found;
}

void HdfFile::read_attribute(const std::string& object, const std::string& name, hid_t type,
                             std::size_t count, void* data) const {
    const HdfHandle found = open_attribute(object, name);
    const HdfHandle space(H5Aget_space(found), H5Sclose);
    check(H5Sget_simple_extent_npoints(space) == static_cast<hssize_t>(count) &&
              H5Aread(found, type, data) >= 0,
          fmt::format("read {}:{}", object, name));
}

std::string HdfFile::text_attribute(const std::string& object, const std::string& name) const {
    const HdfHandle found = open_attribute(object, name);
    const HdfHandle type(H5Aget_type(found), H5Tclose);
    std::string text(H5Tget_size(type), '\0');
    check(H5Tis_variable_str(type) == 0 && H5Aread(found, type, text.data()) >= 0,
          fmt::format("read {}:{}", object, name));
    return text.substr(0, text.find('\0'));  // without the padding
}

}  // namespace hibi
