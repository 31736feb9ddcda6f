#pragma once

#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

// Large arrays that are filled once begin without values, since zeroing them first would cost as much as filling them.

namespace burin {

/// An allocator like std::allocator, but what a vector grows by is left as the memory was.
template <typename T>
struct UnfilledAllocator : std::allocator<T> {
    static_assert(std::is_trivial_v<T>);
    template <typename U>
    struct rebind {
        using other = UnfilledAllocator<U>;
    };
    UnfilledAllocator() = default;
    template <typename U>
    UnfilledAllocator(const UnfilledAllocator<U>&) noexcept {}

    template <typename U>
    void construct(U* at) noexcept {
        ::new (static_cast<void*>(at)) U;
    }
    template <typename U, typename... Arguments>
    void construct(U* at, Arguments&&... arguments) {
        ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
};

/// A vector for memory that is filled once, and large.
template <typename T>
using UnfilledVector = std::vector<T, UnfilledAllocator<T>>;

}  // namespace burin
