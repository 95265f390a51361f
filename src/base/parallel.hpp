#pragma once
#include <algorithm>
#include <vector>

namespace hibi {

/// Number of threads used by parallel_for and parallel_sum (default: all cores of the machine).
int threads();
void set_threads(int count);

/// Elements per block. Block borders depend on n alone, so sums have the same bits on any number of threads.
inline constexpr int parallel_block = 1024;

/// Calls run(body, b) for every b of [0, blocks), spread over the threads. The calling thread takes what no other
/// has begun: it never waits for one that the machine keeps busy elsewhere.
void run_blocks(int blocks, void (*run)(const void* body, int block), const void* body);

/// Calls body(begin, end) for every block of [0, n), blocks spread over the threads.
template <class Body>
void parallel_for(int n, Body&& body) {
    const auto block = [&](int b) { body(b * parallel_block, std::min(n, (b + 1) * parallel_block)); };
    run_blocks((n + parallel_block - 1) / parallel_block,
               [](const void* of, int b) { (*static_cast<const decltype(block)*>(of))(b); }, &block);
}

/// Sum of body(begin, end) over the same blocks, added in the order of the blocks. T needs += and T{} as
/// zero.
template <class T, class Body>
T parallel_sum(int n, Body&& body) {
    const int blocks = (n + parallel_block - 1) / parallel_block;
    std::vector<T> part(blocks);
    parallel_for(n, [&](int begin, int end) { part[begin / parallel_block] = body(begin, end); });
    T sum{};
    for (const T& p : part) sum += p;
    return sum;
}

/// The blocks, by number and rising, for which body(begin, end) is true.
template <class Body>
std::vector<int> blocks_where(int n, Body&& body) {
    std::vector<char> found((n + parallel_block - 1) / parallel_block, 0);
    parallel_for(n, [&](int begin, int end) { found[begin / parallel_block] = body(begin, end); });
    std::vector<int> blocks;
    for (std::size_t b = 0; b < found.size(); ++b)
        if (found[b]) blocks.push_back(static_cast<int>(b));
    return blocks;
}

}  // namespace hibi
