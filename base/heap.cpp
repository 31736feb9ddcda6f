#include "base/heap.h"

#include <cstddef>
#include <cstdlib>
#include <limits>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "base/huge_pages.h"
#include "base/parallel.h"

namespace burin {

void keep_freed_memory([[maybe_unused]] int threads) noexcept {
#ifdef __GLIBC__
    ::mallopt(M_MMAP_MAX, 0);
    constexpr int kThreadsPerHeap = 4;
    ::mallopt(M_ARENA_MAX, (resolve_thread_count(threads) + kThreadsPerHeap - 1) / kThreadsPerHeap);
    ::mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
    // The heap grows by this, and as much of it stays, in huge pages. It is backed by memory when it is written.
    constexpr std::size_t kAtFirst = std::size_t{256} << 20;
    void* const heap = std::malloc(kAtFirst);
    if (heap == nullptr) return;
    advise_huge_pages(heap, kAtFirst);
    std::free(heap);
#endif
}

}  // namespace burin
