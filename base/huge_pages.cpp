#include "base/huge_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace burin {

void advise_huge_pages(void* memory, std::size_t bytes) noexcept {
    constexpr std::uintptr_t kHugePage = std::uintptr_t{1} << 21;
    constexpr std::uintptr_t kPage = 4096;  // at least; madvise refuses other places, which is no harm
    if (bytes < kHugePage) return;
    const auto begin = reinterpret_cast<std::uintptr_t>(memory) / kPage * kPage;
    const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / kPage * kPage;
    ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace burin
