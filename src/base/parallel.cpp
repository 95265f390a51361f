#include "base/parallel.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <memory>

namespace hibi {

namespace {

std::unique_ptr<tbb::task_arena> arena;

/// On the thread that calls: where blocks went the last time, so that they find their data in the same cache.
thread_local tbb::affinity_partitioner as_last_time;
thread_local bool inside = false;

}  // namespace

int threads() { return arena ? arena->max_concurrency() : tbb::this_task_arena::max_concurrency(); }
void set_threads(int count) { arena = std::make_unique<tbb::task_arena>(count); }

void run_blocks(int blocks, void (*run)(const void* body, int block), const void* body) {
    if (inside || blocks < 2 || threads() == 1) {
        for (int b = 0; b < blocks; ++b) run(body, b);
        return;
    }
    const auto all = [&] {
        inside = true;
        tbb::parallel_for(
            tbb::blocked_range<int>(0, blocks, 1),
            [&](const tbb::blocked_range<int>& range) {
                for (int b = range.begin(); b < range.end(); ++b) run(body, b);
            },
            as_last_time);
        inside = false;
    };
    if (arena)
        arena->execute(all);
    else
        all();
}

}  // namespace hibi
