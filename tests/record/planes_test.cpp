#include "record/planes.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <random>

namespace hibi {
namespace {

/// What HDF5 makes of a chunk: inflated, and byte k of number i taken from place k * room + i.
template <class T>
std::vector<T> read_back(std::span<const std::uint8_t> deflated, std::size_t room) {
    std::vector<std::uint8_t> planes(room * sizeof(T)), bytes(planes.size());
    uLongf size = planes.size();
    EXPECT_EQ(uncompress(planes.data(), &size, deflated.data(), deflated.size()), Z_OK);
    EXPECT_EQ(size, planes.size());
    for (std::size_t i = 0; i < room; ++i)
        for (std::size_t k = 0; k < sizeof(T); ++k) bytes[i * sizeof(T) + k] = planes[k * room + i];
    std::vector<T> numbers(room);
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

template <class T>
std::span<const std::uint8_t> deflated(PlaneDeflater& deflater, const std::vector<T>& numbers) {
    return deflater.deflate(reinterpret_cast<const std::uint8_t*>(numbers.data()), sizeof(T), numbers.size(),
                            sizeof(T), numbers.size());
}

/// A smooth field with noise in its last digits, as displacements are.
std::vector<double> smooth(std::size_t count) {
    std::mt19937 random(1);
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count; ++i)
        numbers.push_back(1e-5 * (2 + std::sin(static_cast<double>(i) / 300)) +
                          1e-13 * static_cast<double>(random() % 1000));
    return numbers;
}

TEST(Planes, NumbersComeBackBitForBit) {
    PlaneDeflater deflater;
    std::mt19937 random(2);
    const std::vector<double> field = smooth(65'536), zeros(65'536, 0);
    std::vector<std::int32_t> noise(5000);
    for (std::int32_t& n : noise) n = static_cast<std::int32_t>(random());
    const std::vector<std::uint8_t> flags{0, 1, 1, 0, 0, 1, 7};
    EXPECT_TRUE(read_back<double>(deflated(deflater, field), field.size()) == field);
    EXPECT_TRUE(read_back<double>(deflated(deflater, zeros), zeros.size()) == zeros);
    EXPECT_TRUE(read_back<std::int32_t>(deflated(deflater, noise), noise.size()) == noise);
    EXPECT_TRUE(read_back<std::uint8_t>(deflated(deflater, flags), flags.size()) == flags);
}

TEST(Planes, AColumnOfATableIsTakenAndFilledUpWithZeros) {
    const std::vector<float> table{1, 2, 3, 4, 5, 6};  // two columns
    PlaneDeflater deflater;
    const auto bytes = deflater.deflate(reinterpret_cast<const std::uint8_t*>(&table[1]), 2 * sizeof(float),
                                        3, sizeof(float), 5);
    EXPECT_EQ(read_back<float>(bytes, 5), (std::vector<float>{2, 4, 6, 0, 0}));
}

TEST(Planes, WhatIsReadBackHereIsWhatHdf5Reads) {
    const std::vector<double> table = smooth(600);  // three columns of 200
    PlaneDeflater deflater;
    const auto deflated = deflater.deflate(reinterpret_cast<const std::uint8_t*>(&table[2]),
                                           3 * sizeof(double), 200, sizeof(double), 256);
    std::vector<std::uint8_t> planes(256 * sizeof(double));
    std::vector<double> back(600, 0);
    ASSERT_TRUE(inflate_planes(deflated, planes, reinterpret_cast<std::uint8_t*>(&back[2]),
                               3 * sizeof(double), 200, sizeof(double)));
    const std::vector<double> expected = read_back<double>(deflated, 256);
    for (std::size_t i = 0; i < 200; ++i) {
        EXPECT_EQ(back[3 * i + 2], table[3 * i + 2]);
        EXPECT_EQ(back[3 * i + 2], expected[i]);
        EXPECT_EQ(back[3 * i], 0);
    }
    std::vector<std::uint8_t> damaged(deflated.begin(), deflated.end());
    damaged[damaged.size() / 2] ^= 1;
    EXPECT_FALSE(inflate_planes(damaged, planes, reinterpret_cast<std::uint8_t*>(&back[2]),
                                3 * sizeof(double), 200, sizeof(double)));
}

TEST(Planes, NoiseIsStoredAndTheRestIsSmall) {
    constexpr std::size_t count = 65'536;
    PlaneDeflater deflater;
    EXPECT_LT(deflated(deflater, std::vector<double>(count, 0)).size(), count / 50);
    std::mt19937_64 random(3);
    std::vector<std::uint64_t> noise(count);
    for (std::uint64_t& n : noise) n = random();
    EXPECT_LT(deflated(deflater, noise).size(), count * 8 * 1.001);
    EXPECT_LT(deflated(deflater, smooth(count)).size(), count * 8 * 0.8);
}

TEST(Planes, TheSameNumbersGiveTheSameBytes) {
    PlaneDeflater used, fresh;
    deflated(used, std::vector<float>(1000, 3));
    const std::vector<double> field = smooth(4096);
    const auto a = deflated(used, field), b = deflated(fresh, field);
    EXPECT_TRUE(std::ranges::equal(a, b));
}

}  // namespace
}  // namespace hibi
