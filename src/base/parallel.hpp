#pragma once
#include <algorithm>
#include <vector>

namespace hibi {

/// Number of threads used by parallel_for and parallel_sum (default: all cores of the machine).
int threads();
void set_threads(int count);

/// Elements per block. Block borders depend on n alone, so sums have the same bits on any number of threads.
inline constexpr int parallel_block = 1024;

/// Calls run(body, b) for every b of [0, blocks), spread over the threads. The calling thread takes what no
/// other has begun: it never waits for one that the machine keeps busy elsewhere.
void run_blocks(int blocks, void (*run)(const void* body, int block), const void* body);

/// Number of blocks that n elements make.
constexpr int block_count(int n) { return (n + parallel_block - 1) / parallel_block; }

/// Calls body(b) for every b of [0, blocks), spread over the threads.
template <class Body>
void parallel_blocks(int blocks, const Body& body) {
    run_blocks(
        blocks, [](const void* of, int b) { (*static_cast<const Body*>(of))(b); }, &body);
}

/// Calls body(begin, end) for every block of [0, n), blocks spread over the threads.
template <class Body>
void parallel_for(int n, const Body& body) {
    parallel_blocks(block_count(n),
                    [&](int b) { body(b * parallel_block, std::min(n, (b + 1) * parallel_block)); });
}

/// Where `found` is true, rising: of blocks, say, each of which noted what it found.
inline std::vector<int> true_places(const std::vector<char>& found) {
    std::vector<int> places;
    for (std::size_t k = 0; k < found.size(); ++k)
        if (found[k]) places.push_back(static_cast<int>(k));
    return places;
}

/// Sum of body(begin, end) over the same blocks, added in the order of the blocks. T needs += and T{} as
/// zero.
template <class T, class Body>
T parallel_sum(int n, Body&& body) {
    std::vector<T> part(block_count(n));
    parallel_for(n, [&](int begin, int end) { part[begin / parallel_block] = body(begin, end); });
    T sum{};
    for (const T& p : part) sum += p;
    return sum;
}

}  // namespace hibi
