#include "elasticity/block_order.hpp"

#include <algorithm>

#include "elasticity/bond_kernel.hpp"

namespace hibi {

namespace {

/// What fewer blocks need stays in the cache anyhow.
constexpr int large_body = 64;
/// Segments for each thread, so that none waits long for another's last.
constexpr int segments_per_thread = 4;

}  // namespace

BlockOrder::BlockOrder(const Bonds& bonds) {
    const int particles = static_cast<int>(bonds.start.size()) - 1, blocks = block_count(particles);
    // A loop over chunks reads for its lanes without a bond what lies beside the others' neighbours.
    constexpr int beside = kernel::lanes - 1;
    std::vector<int> first(blocks), last(blocks);
    for (int b = 0; b < blocks; ++b) first[b] = last[b] = b;
    const auto leads = [&](int from, int to) {
        int& low = first[from / parallel_block];
        int& high = last[from / parallel_block];
        low = std::min(low, std::max(0, to - beside) / parallel_block);
        high = std::max(high, std::min(particles - 1, to + beside) / parallel_block);
    };
    for (int b = 0; b < bonds.count(); ++b) {
        leads(bonds.first[b], bonds.second[b]);
        leads(bonds.second[b], bonds.first[b]);
    }
    const int segments = segments_per_thread * std::max(1, threads());
    const int length = blocks < large_body ? 1 : std::max(1, blocks / segments);
    for (int begin = 0; begin < blocks; begin += length) segments_.push_back(begin);
    segments_.push_back(blocks);
    last_ = last;
    for (int b = 0; b < blocks; ++b) {
        const int begin = b / length * length;
        if (first[b] >= begin && last[b] < begin + length) continue;
        last_[b] = -1;
        later_.push_back(b);
    }
}

}  // namespace hibi
