#include "base/memory.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace hibi {

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

bool is_limited(decltype(RLIMIT_AS) what) {
    rlimit limit{};
    return getrlimit(what, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY;
}

bool promises_only_what_it_has() {
    int policy = 0;
    std::ifstream("/proc/sys/vm/overcommit_memory") >> policy;
    return policy == 2;
}

}  // namespace

bool keep_freed_memory() {
    if (is_limited(RLIMIT_AS) || is_limited(RLIMIT_DATA) || promises_only_what_it_has()) return false;
    mallopt(M_ARENA_MAX, 1);        // one heap for all threads,
    mallopt(M_MMAP_MAX, 0);         // large blocks come from it as well,
    mallopt(M_TRIM_THRESHOLD, -1);  // and it never shrinks.
    // It is stretched, without being used, and marked for large pages.
    constexpr std::uint64_t most = std::uint64_t{8} << 30;
    const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
    const std::uint64_t half = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * page / 2;
    const auto size = static_cast<std::size_t>(std::min({half, most, std::uint64_t{SIZE_MAX} / 8}));
    void* const heap = std::malloc(size);
    if (!heap) return true;  // kept, if in small pages
    const auto begin = (reinterpret_cast<std::uintptr_t>(heap) + page - 1) / page * page;
    madvise(reinterpret_cast<void*>(begin), size - 2 * page, MADV_HUGEPAGE);
    std::free(heap);
    return true;
}

#else

bool keep_freed_memory() { return false; }

#endif

}  // namespace hibi
