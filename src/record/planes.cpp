#include "record/planes.hpp"

#include <zlib.h>

#include <array>
#include <cassert>
#include <new>

namespace hibi {

namespace {

/// Byte k of every number into plane k.
template <std::size_t Size>
void shuffle(const std::uint8_t* numbers, std::size_t stride, std::size_t count, std::size_t room,
             std::uint8_t* planes) {
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < Size; ++k) planes[k * room + i] = numbers[i * stride + k];
}

template <std::size_t Size>
void unshuffle(const std::uint8_t* planes, std::size_t room, std::size_t count, std::uint8_t* numbers,
               std::size_t stride) {
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < Size; ++k) numbers[i * stride + k] = planes[k * room + i];
}

/// Would a code that knows how often each byte occurs save too little for its time? By the chance that two
/// bytes are equal, 1/256 for noise; at this limit it saves a sixth.
bool is_noise(std::span<const std::uint8_t> plane) {
    constexpr double limit = 3.0 / 256;
    const std::size_t each = 1 + plane.size() / 8192;  // of many a sample is enough
    std::array<std::uint32_t, 256> counts{};
    double looked_at = 0, pairs = 0;
    for (std::size_t i = 0; i < plane.size(); i += each, ++looked_at) ++counts[plane[i]];
    for (const double count : counts) pairs += count * (count - 1);
    return pairs < limit * looked_at * (looked_at - 1);
}

}  // namespace

struct PlaneDeflater::Stream {
    z_stream z{};
};

PlaneDeflater::PlaneDeflater() : stream_(std::make_unique<Stream>()) {
    constexpr int window = 15, memory = 9;  // larger blocks, fewer code tables
    if (deflateInit2(&stream_->z, 1, Z_DEFLATED, window, memory, Z_RLE) != Z_OK) throw std::bad_alloc();
}

PlaneDeflater::~PlaneDeflater() { deflateEnd(&stream_->z); }

std::span<const std::uint8_t> PlaneDeflater::deflate(const std::uint8_t* numbers, std::size_t stride,
                                                     std::size_t count, std::size_t size, std::size_t room) {
    planes_.assign(room * size, 0);
    switch (size) {
        case 1:
            shuffle<1>(numbers, stride, count, room, planes_.data());
            break;
        case 4:
            shuffle<4>(numbers, stride, count, room, planes_.data());
            break;
        default:
            assert(size == 8);
            shuffle<8>(numbers, stride, count, room, planes_.data());
    }
    z_stream& z = stream_->z;
    deflateReset(&z);
    // Room for what each change of the method may add, so that no call needs a second one.
    deflated_.resize(deflateBound(&z, planes_.size()) + 64 * size);
    z.next_out = deflated_.data();
    z.avail_out = static_cast<uInt>(deflated_.size());
    for (std::size_t k = 0; k < size; ++k) {
        const std::span<std::uint8_t> plane(planes_.data() + k * room, room);
        deflateParams(&z, is_noise(plane) ? 0 : 1, Z_RLE);
        z.next_in = plane.data();
        z.avail_in = static_cast<uInt>(room);
        ::deflate(&z, k + 1 < size ? Z_NO_FLUSH : Z_FINISH);
    }
    return {deflated_.data(), deflated_.size() - z.avail_out};
}

bool inflate_planes(std::span<const std::uint8_t> deflated, std::span<std::uint8_t> planes,
                    std::uint8_t* numbers, std::size_t stride, std::size_t count, std::size_t size) {
    uLongf inflated = planes.size();
    if (uncompress(planes.data(), &inflated, deflated.data(), deflated.size()) != Z_OK ||
        inflated != planes.size())
        return false;
    const std::size_t room = planes.size() / size;
    if (size == 8)
        unshuffle<8>(planes.data(), room, count, numbers, stride);
    else if (size == 4)
        unshuffle<4>(planes.data(), room, count, numbers, stride);
    else
        unshuffle<1>(planes.data(), room, count, numbers, stride);
    return true;
}

}  // namespace hibi
