#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <bit>
#include <cstdint>

#include "mesh/digit_scan.h"

// A row of three plain numbers is read as a whole, with SSE2.

namespace burin {

/// Rows of three plain numbers with one space between them, which most rows of model files are. Where
/// the numbers end is found for the whole row at once: one after the other, as in digit_scan.h, each
/// waits for the one before. Where there is no SSE2 no row is taken for one of these.

/// How many bytes behind and in front of its start a scan below may look at.
constexpr std::ptrdiff_t kRowReach = 72, kRowReachBack = 16;

#ifdef __SSE2__
/// Bit i: p[i] is none of 0 1 2 3 4 5 6 7 8 9; bit i of `minus`: p[i] is '-'.
struct RowMarks {
    std::uint64_t others = 0, minus = 0;
};
template <int kCharacters>
RowMarks find_marks(const char* p) {
    RowMarks marks;
    for (int i = 0; i < kCharacters; i += 16) {
        const __m128i text = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p + i));
        const __m128i digit = _mm_xor_si128(text, _mm_set1_epi8('0'));
        const __m128i is_digit = _mm_cmpeq_epi8(_mm_min_epu8(digit, _mm_set1_epi8(9)), digit);
        const __m128i is_minus = _mm_cmpeq_epi8(text, _mm_set1_epi8('-'));
        const auto bits = [&](__m128i which) {
            return std::uint64_t{static_cast<std::uint32_t>(_mm_movemask_epi8(which))} << i;
        };
        marks.others |= bits(is_digit) ^ 0xFFFFull << i;
        marks.minus |= bits(is_minus);
    }
    return marks;
}

/// 0xFF for the last `count` of sixteen bytes.
inline __m128i last_bytes(int count) {
    static constexpr std::uint64_t kTable[] = {0, 0, ~std::uint64_t{0}, ~std::uint64_t{0}};
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(reinterpret_cast<const char*>(kTable) + count));
}
inline __m128i load_sixteen(const char* p) {
    return _mm_xor_si128(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p)), _mm_set1_epi8('0'));
}
/// Four numbers below 10,000 from sixteen digits 0..9.
inline __m128i fours_of_digits(__m128i digits) {
    const __m128i tens = _mm_mullo_epi16(_mm_and_si128(digits, _mm_set1_epi16(0xFF)), _mm_set1_epi16(10));
    return _mm_madd_epi16(_mm_add_epi16(tens, _mm_srli_epi16(digits, 8)), _mm_set1_epi32(1 << 16 | 100));
}
/// Four numbers of eight digits each.
inline __m128i eights_of_fours(__m128i first_two, __m128i last_two) {
    return _mm_madd_epi16(_mm_packs_epi32(first_two, last_two), _mm_set1_epi32(1 << 16 | 10000));
}
#endif

/// Reads three integers of 1..7 digits. Returns the place behind them, where a space or a line feed
/// stands, or nullptr for any other text. `values` has a fourth place, which is overwritten.
inline const char* scan_three_integers([[maybe_unused]] const char* p, [[maybe_unused]] std::uint32_t* values) {
#ifdef __SSE2__
    std::uint64_t others = find_marks<32>(p).others;
    __m128i digits[3];
    int begin = 0;
    for (int k = 0; k < 3; ++k) {
        const int end = std::countr_zero(others);
        const char behind = p[end];
        if (static_cast<unsigned>(end - begin - 1) > 6) return nullptr;
        if (behind != ' ' && !(k == 2 && behind == '\n')) return nullptr;
        digits[k] = _mm_and_si128(load_sixteen(p + end - 16), last_bytes(end - begin));
        others &= others - 1;
        begin = end + 1;
    }
    const __m128i first_two = _mm_unpackhi_epi64(digits[0], digits[1]),
                  last_two = _mm_unpackhi_epi64(digits[2], digits[2]);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(values),
                     eights_of_fours(fours_of_digits(first_two), fours_of_digits(last_two)));
    return p + begin - 1;
#else
    return nullptr;
#endif
}

/// Reads three numbers like -12.345, each with a digit at least on either side of its point and 15 at most.
/// Returns the place behind them, where a space or a line feed stands, or nullptr for any other text.
/// Values are those of scan_number().
inline const char* scan_three_decimals([[maybe_unused]] const char* p, [[maybe_unused]] double* values) {
#ifdef __SSE2__
    const RowMarks marks = find_marks<64>(p);
    std::uint64_t others = marks.others & ~marks.minus, minus_signs = 0;
    __m128i fours[3];
    double scale[3];
    std::uint64_t sign[3];
    int begin = 0;
    for (int k = 0; k < 3; ++k) {
        const int negative = p[begin] == '-' ? 1 : 0;
        const int point = std::countr_zero(others);
        others &= others - 1;
        const int end = std::countr_zero(others);
        others &= others - 1;
        if (end >= 64 || p[point] != '.') return nullptr;
        const char behind = p[end];
        if (behind != ' ' && !(k == 2 && behind == '\n')) return nullptr;
        const int whole = point - begin - negative, places = end - point - 1;
        if (whole < 1 || places < 1 || whole + places > 15) return nullptr;
        // All digits as one number: two views of the text leave out the point.
        const __m128i is_fraction = last_bytes(places);
        const __m128i digits = _mm_or_si128(_mm_and_si128(is_fraction, load_sixteen(p + end - 16)),
                                            _mm_andnot_si128(is_fraction, load_sixteen(p + end - 17)));
        fours[k] = fours_of_digits(_mm_and_si128(digits, last_bytes(whole + places)));
        scale[k] = kPowersOfTen[places];
        sign[k] = static_cast<std::uint64_t>(negative) << 63;
        minus_signs |= static_cast<std::uint64_t>(negative) << begin;
        begin = end + 1;
    }
    // Up to 15 digits fit a double, so each division is the only rounding, as in scan_plain_decimal().
    const auto magnitudes = [](__m128i two_of_sixteen, __m128d by) {
        const __m128d first = _mm_cvtepi32_pd(two_of_sixteen);
        const __m128d second = _mm_cvtepi32_pd(_mm_unpackhi_epi64(two_of_sixteen, two_of_sixteen));
        const __m128d high = _mm_unpacklo_pd(first, second), low = _mm_unpackhi_pd(first, second);
        return _mm_div_pd(_mm_add_pd(_mm_mul_pd(high, _mm_set1_pd(1e8)), low), by);
    };
    const auto bits = [&](int k) { return static_cast<long long>(sign[k]); };
    const __m128d xy = magnitudes(eights_of_fours(fours[0], fours[1]), _mm_set_pd(scale[1], scale[0]));
    const __m128d z = magnitudes(eights_of_fours(fours[2], fours[2]), _mm_set1_pd(scale[2]));
    _mm_storeu_pd(values, _mm_xor_pd(xy, _mm_castsi128_pd(_mm_set_epi64x(bits(1), bits(0)))));
    _mm_store_sd(values + 2, _mm_xor_pd(z, _mm_castsi128_pd(_mm_set1_epi64x(bits(2)))));
    const std::uint64_t row = ~std::uint64_t{0} >> (64 - begin);
    return (marks.minus & row) == minus_signs ? p + begin - 1 : nullptr;
#else
    return nullptr;
#endif
}

}  // namespace burin
