#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace hibi {

/// Makes what HDF5's filters "shuffle" and "deflate" read, but many times faster than they write it.
/// Shuffled, a chunk of numbers falls into planes: the first bytes of all numbers, their second bytes, and so
/// on. The planes of the last digits are noise, on which deflate spends most of its time and gains nothing:
/// these are stored. In the others it looks for runs of equal bytes alone.
class PlaneDeflater {
 public:
    PlaneDeflater();
    ~PlaneDeflater();
    PlaneDeflater(const PlaneDeflater&) = delete;
    PlaneDeflater& operator=(const PlaneDeflater&) = delete;

    /// A chunk of `room` numbers of `size` bytes: `count` that stand `stride` bytes apart, and zeros behind
    /// them. A zlib stream, which holds until the next call. The same numbers give the same bytes.
    std::span<const std::uint8_t> deflate(const std::uint8_t* numbers, std::size_t stride, std::size_t count,
                                          std::size_t size, std::size_t room);

 private:
    struct Stream;
    std::unique_ptr<Stream> stream_;
    std::vector<std::uint8_t> planes_, deflated_;
};

/// The way back: `count` numbers of `size` bytes, `stride` bytes apart. `planes` has as many bytes as the
/// chunk. False where the stream is damaged.
bool inflate_planes(std::span<const std::uint8_t> deflated, std::span<std::uint8_t> planes,
                    std::uint8_t* numbers, std::size_t stride, std::size_t count, std::size_t size);

}  // namespace hibi
