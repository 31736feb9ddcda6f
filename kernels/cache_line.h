#pragma once

#include <cstddef>
#include <new>

// Arrays that kernels read begin with a cache line.

namespace burin {

/// An allocator for vectors that begin with a cache line: wide loads from them need not touch two.
template <typename T>
struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::align_val_t kCacheLine{64};

    CacheLineAllocator() = default;
    template <typename U>
    CacheLineAllocator(const CacheLineAllocator<U>&) {}

    T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), kCacheLine)); }
    void deallocate(T* p, std::size_t) { ::operator delete(p, kCacheLine); }
    bool operator==(const CacheLineAllocator&) const = default;
};

}  // namespace burin
