#include "base/memory.hpp"

#include <cstdint>
#include <cstdlib>
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace hibi {

void keep_freed_memory() {
#ifdef __GLIBC__
    mallopt(M_MMAP_MAX, 0);         // large blocks come from the heap as well,
    mallopt(M_TRIM_THRESHOLD, -1);  // which never shrinks
    // The heap is stretched, without being used, over as much as the machine has, and marked for large pages.
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const std::size_t all = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES)) * page;
    void* const heap = std::malloc(all / 2);
    if (!heap) return;
    const std::uintptr_t begin = (reinterpret_cast<std::uintptr_t>(heap) + page - 1) / page * page;
    madvise(reinterpret_cast<void*>(begin), all / 2 - 2 * page, MADV_HUGEPAGE);
    std::free(heap);
#endif
}

}  // namespace hibi
