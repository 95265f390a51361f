#pragma once
#include <hdf5.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/vec.hpp"

namespace hibi {

/// A handle of HDF5, closed when it goes out of scope.
class HdfHandle {
 public:
    HdfHandle(hid_t id, herr_t (*closer)(hid_t)) : id_(id), close_(closer) {}
    HdfHandle(HdfHandle&& other) noexcept : id_(other.id_), close_(other.close_) {
        other.id_ = H5I_INVALID_HID;
    }
    HdfHandle(const HdfHandle&) = delete;
    HdfHandle& operator=(const HdfHandle&) = delete;
    ~HdfHandle() { close(); }

    bool valid() const { return id_ >= 0; }
    operator hid_t() const { return id_; }
    /// False where HDF5 could not close it, and with it could not write what was left.
    bool close() {
        const bool closed = id_ < 0 || close_(id_) >= 0;
        id_ = H5I_INVALID_HID;
        return closed;
    }

 private:
    hid_t id_;
    herr_t (*close_)(hid_t);
};

/// How one entry of an array is stored: `width` numbers of one type in a row. Doubles lose no bit.
template <class T>
struct HdfEntry;

/// One HDF5 file, written or read. Objects are named by their path in the file. Every error is a
/// std::runtime_error naming the file, the object and HDF5's own reason.
class HdfFile {
 public:
    static HdfFile create(const std::filesystem::path& file);
    static HdfFile open(const std::filesystem::path& file);

    void group(const std::string& name);
    /// Chunked, shuffled, deflated; without the time of writing, so that equal content gives equal bytes.
    template <class T>
    void write(const std::string& name, const std::vector<T>& data) {
        write(name, HdfEntry<T>::type(), HdfEntry<T>::width, data.size(), data.data());
    }
    template <class T>
    void attribute(const std::string& object, const std::string& name, const std::vector<T>& data) {
        write_attribute(object, name, HdfEntry<T>::type(), HdfEntry<T>::width * data.size(), data.data());
    }
    /// Fixed length, as VTK wants its type name; UTF-8 where it has to be.
    void attribute(const std::string& object, const std::string& name, const std::string& text);
    /// `name` stands for `target` in another file of the same folder.
    void link(const std::string& name, const std::string& file, const std::string& target);
    void close();

    bool has(const std::string& name) const;
    /// `rows` is how many entries there must be; -1: any number.
    template <class T>
    std::vector<T> read(const std::string& name, std::int64_t rows = -1) const {
        const HdfHandle dataset = open_dataset(name);
        std::vector<T> data(check_rows(dataset, name, HdfEntry<T>::width, rows));
        read_dataset(dataset, name, HdfEntry<T>::type(), HdfEntry<T>::width, data.size(), data.data());
        return data;
    }
    template <class T>
    std::vector<T> attribute(const std::string& object, const std::string& name, int count) const {
        std::vector<T> data(count);
        read_attribute(object, name, HdfEntry<T>::type(), HdfEntry<T>::width * data.size(), data.data());
        return data;
    }
    std::string text_attribute(const std::string& object, const std::string& name) const;

    /// Throws, with the file's name in front.
    [[noreturn]] void fail(const std::string& what) const;

 private:
    HdfFile(std::filesystem::path file, HdfHandle handle)
        : file_(std::move(file)), handle_(std::move(handle)) {}

    void check(bool good, const std::string& operation) const;
    void write(const std::string& name, hid_t type, std::size_t width, std::size_t rows, const void* data);
    static bool write_chunks(hid_t dataset, std::size_t number_size, std::size_t width, std::size_t rows,
                             std::size_t chunk_size, const void* data);
    void write_attribute(const std::string& object, const std::string& name, hid_t type, std::size_t count,
                         const void* data);
    HdfHandle open_dataset(const std::string& name) const;
    HdfHandle open_attribute(const std::string& object, const std::string& name) const;
    std::size_t check_rows(hid_t dataset, const std::string& name, std::size_t width,
                           std::int64_t rows) const;
    void read_dataset(hid_t dataset, const std::string& name, hid_t type, std::size_t width, std::size_t rows,
                      void* data) const;
    static bool read_columns(hid_t dataset, std::size_t number_size, std::size_t width, std::size_t rows,
                             std::size_t chunk_size, void* data);
    void read_attribute(const std::string& object, const std::string& name, hid_t type, std::size_t count,
                        void* data) const;

    std::filesystem::path file_;
    HdfHandle handle_;
};

template <>
struct HdfEntry<std::uint8_t> {
    static constexpr std::size_t width = 1;
    static hid_t type() { return H5T_NATIVE_UINT8; }
};
template <>
struct HdfEntry<std::int32_t> {
    static constexpr std::size_t width = 1;
    static hid_t type() { return H5T_NATIVE_INT32; }
};
template <>
struct HdfEntry<std::int64_t> {
    static constexpr std::size_t width = 1;
    static hid_t type() { return H5T_NATIVE_INT64; }
};
template <>
struct HdfEntry<float> {
    static constexpr std::size_t width = 1;
    static hid_t type() { return H5T_NATIVE_FLOAT; }
};
template <>
struct HdfEntry<double> {
    static constexpr std::size_t width = 1;
    static hid_t type() { return H5T_NATIVE_DOUBLE; }
};
template <>
struct HdfEntry<Vec3> {
    static constexpr std::size_t width = 3;
    static hid_t type() { return H5T_NATIVE_DOUBLE; }
};
template <class T, std::size_t N>
struct HdfEntry<std::array<T, N>> {
    static constexpr std::size_t width = N * HdfEntry<T>::width;
    static hid_t type() { return HdfEntry<T>::type(); }
};

}  // namespace hibi
