#pragma once

#include <cstddef>
#include <vector>

namespace burin {

/// Asks the system to back memory that has not been written yet by huge pages. A first write to an
/// ordinary page of 4 KB costs about as much as filling it several times over; there are 512 of
/// them in a huge one. Only a hint: does nothing for little memory or where there are none.
void advise_huge_pages(void* memory, std::size_t bytes) noexcept;

/// Reserves place in an empty vector that may become large, and is filled at once.
template <typename T, typename Allocator>
void reserve_large(std::vector<T, Allocator>& v, std::size_t count) {
    v.reserve(count);
    advise_huge_pages(v.data(), count * sizeof(T));
}

/// A vector of `count` equal values that may be large.
template <typename T>
std::vector<T> large_vector(std::size_t count, const T& value = T()) {
    std::vector<T> v;
    reserve_large(v, count);
    v.resize(count, value);
    return v;
}

}  // namespace burin
