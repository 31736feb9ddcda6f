#include "tests/support/counting_heap.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::size_t> used{0}, most{0};

void* counted(void* memory) {
    if (memory == nullptr) throw std::bad_alloc();
    const std::size_t now = used += ::malloc_usable_size(memory);
    for (std::size_t before = most; before < now && !most.compare_exchange_weak(before, now);) {
    }
    return memory;
}

void release(void* memory) noexcept {
    if (memory != nullptr) used -= ::malloc_usable_size(memory);
    std::free(memory);
}

}  // namespace

namespace burin::test {

std::size_t CountingHeap::now() { return used; }
std::size_t CountingHeap::peak() { return most; }
void CountingHeap::forget_peak() { most = used.load(); }

}  // namespace burin::test

// The other forms of new and delete call these.
void* operator new(std::size_t bytes) { return counted(std::malloc(bytes)); }
void* operator new(std::size_t bytes, std::align_val_t alignment) {
    const auto a = static_cast<std::size_t>(alignment);
    return counted(std::aligned_alloc(a, (bytes + a - 1) / a * a));
}
// A sanitizer's library has these of its own, which would not be counted.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
    void* const memory = std::malloc(bytes);
    return memory == nullptr ? nullptr : counted(memory);
}
void operator delete(void* memory) noexcept { release(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { release(memory); }
void operator delete(void* memory, std::size_t) noexcept { release(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { release(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { release(memory); }
