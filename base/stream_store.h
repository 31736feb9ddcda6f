#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <type_traits>

// Large results that nobody reads soon are written past the caches, so that they push nothing else out.

namespace burin {

/// Stores for memory that is filled long before it is read: written past the caches, it need not be fetched first and
/// pushes nothing else out. On processors without such stores they are ordinary ones.
///
/// Other threads may miss what was written until the writing one has called finish_stream_stores().

inline void finish_stream_stores() {
#ifdef __SSE2__
    _mm_sfence();
#endif
}

/// Goes over memory by whole cache lines, and by single values before and behind them.
template <typename T, typename PutLine, typename PutValue>
void for_each_cache_line(T* to, std::size_t count, const PutLine& put_line, const PutValue& put_value) {
    constexpr std::size_t kLineBytes = 64, kPerLine = kLineBytes / sizeof(T);
    static_assert(std::is_trivially_copyable_v<T> && kLineBytes % sizeof(T) == 0);
    T* const end = to + count;
    while (to < end && reinterpret_cast<std::uintptr_t>(to) % kLineBytes != 0) put_value(to++);
    for (; end - to >= static_cast<std::ptrdiff_t>(kPerLine); to += kPerLine) put_line(to);
    while (to < end) put_value(to++);
}

template <typename T>
void stream_copy(const T* from, std::size_t count, T* to) {
#ifdef __SSE2__
    const auto source = [&](const T* at) { return from + (at - to); };
    for_each_cache_line(
        to, count,
        [&](T* line) {
            const auto* const p = reinterpret_cast<const __m128i*>(source(line));
            for (int k = 0; k < 4; ++k) _mm_stream_si128(reinterpret_cast<__m128i*>(line) + k, _mm_loadu_si128(p + k));
        },
        [&](T* at) { *at = *source(at); });
#else
    std::copy_n(from, count, to);
#endif
}

template <typename T>
void stream_fill(T* to, std::size_t count, T value) {
#ifdef __SSE2__
    alignas(16) T part[16 / sizeof(T)];
    std::fill(std::begin(part), std::end(part), value);
    const __m128i values = _mm_load_si128(reinterpret_cast<const __m128i*>(part));
    for_each_cache_line(
        to, count,
        [&](T* line) {
            for (int k = 0; k < 4; ++k) _mm_stream_si128(reinterpret_cast<__m128i*>(line) + k, values);
        },
        [&](T* at) { *at = value; });
#else
    std::fill_n(to, count, value);
#endif
}

}  // namespace burin
