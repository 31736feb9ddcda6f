#pragma once

#ifdef __SSE2__
#include <emmintrin.h>

#include <bit>
#endif

// Texts of all systems are read, whatever ends their lines.

namespace burin {

/// Lines end in LF, in CR and LF, or, as old Mac programs have it, in CR alone; in one file each
/// line may do as it likes.
inline bool is_line_end(char c) { return c == '\n' || c == '\r'; }

/// The first LF or CR from `p` on; `end` where there is none.
inline const char* find_line_end(const char* p, const char* end) {
#ifdef __SSE2__
    const __m128i feed = _mm_set1_epi8('\n'), carriage_return = _mm_set1_epi8('\r');
    for (; end - p >= 16; p += 16) {
        const __m128i text = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
        const int found =
            _mm_movemask_epi8(_mm_or_si128(_mm_cmpeq_epi8(text, feed), _mm_cmpeq_epi8(text, carriage_return)));
        if (found != 0) return p + std::countr_zero(static_cast<unsigned>(found));
    }
#endif
    while (p < end && !is_line_end(*p)) ++p;
    return p;
}

/// Whether a CR stands at `p` without an LF behind it.
inline bool is_lone_carriage_return(const char* p, const char* end) {
    return *p == '\r' && !(end - p > 1 && p[1] == '\n');
}

/// The place behind the line end at `p`.
inline const char* behind_line_end(const char* p, const char* end) {
    if (p == end) return end;
    return p + (*p == '\r' && !is_lone_carriage_return(p, end) ? 2 : 1);
}

}  // namespace burin
