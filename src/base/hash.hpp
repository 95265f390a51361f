#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hibi {

/// SHA-256 of the bytes, as 64 hexadecimal digits.
std::string sha256(const void* data, std::size_t size);
inline std::string sha256(std::string_view text) { return sha256(text.data(), text.size()); }

/// A well-mixed 64-bit number from a counter: reproducible randomness that does not depend on any order.
/// Steele, Lea, Flood 2014 (SplitMix64), finalizer.
constexpr std::uint64_t mix_bits(std::uint64_t z) {
    z += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/// Uniform in (0, 1), never 0 or 1.
constexpr double unit_random(std::uint64_t bits) { return (static_cast<double>(bits >> 12) + 0.5) * 0x1p-52; }

}  // namespace hibi
