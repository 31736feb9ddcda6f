#pragma once

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <bit>
#include <cstdint>

#include "mesh/digit_scan.h"

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
#endif

/// The number that the `count` characters in front of `end` make, 1..8 digits.
inline std::uint32_t value_of_digits_before(const char* end, int count) {
    const int rest = 64 - 8 * count;
    return value_of_digits(load_eight(end - 8) >> rest, count);
}

/// Reads three integers of 1..7 digits. Returns the place behind them, where a space or a line feed
/// stands, or nullptr for any other text.
inline const char* scan_three_integers([[maybe_unused]] const char* p,
                                       [[maybe_unused]] std::uint32_t* values) {
#ifdef __SSE2__
    std::uint64_t others = find_marks<32>(p).others;
    int begin = 0;
    for (int k = 0; k < 3; ++k) {
        const int end = std::countr_zero(others);
        const char behind = p[end];
        if (static_cast<unsigned>(end - begin - 1) > 6) return nullptr;
        if (behind != ' ' && !(k == 2 && behind == '\n')) return nullptr;
        values[k] = value_of_digits_before(p + end, end - begin);
        others &= others - 1;
        begin = end + 1;
    }
    return p + begin - 1;
#else
    return nullptr;
#endif
}

/// Reads three numbers like -12.345, each with 1..7 digits before its point and 1..8 behind it.
/// Returns the place behind them, where a space or a line feed stands, or nullptr for any other text.
/// Values are those of scan_plain_decimal().
inline const char* scan_three_decimals([[maybe_unused]] const char* p,
                                       [[maybe_unused]] double* values) {
#ifdef __SSE2__
    const RowMarks marks = find_marks<64>(p);
    std::uint64_t others = marks.others & ~marks.minus, minus_signs = 0;
    int begin = 0;
    for (int k = 0; k < 3; ++k) {
        const bool negative = p[begin] == '-';
        const int point = std::countr_zero(others);
        others &= others - 1;
        const int end = std::countr_zero(others);
        others &= others - 1;
        if (end >= 64 || p[point] != '.') return nullptr;
        const char behind = p[end];
        if (behind != ' ' && !(k == 2 && behind == '\n')) return nullptr;
        minus_signs |= std::uint64_t{negative} << begin;
        const int whole = point - begin - (negative ? 1 : 0), places = end - point - 1;
        if (static_cast<unsigned>(whole - 1) > 6 || static_cast<unsigned>(places - 1) > 7) return nullptr;
        std::int64_t digits = 0;
        if (whole + places <= 8) {  // as one number, from two views of the text that leave out the point
            const std::uint64_t behind_point = ~std::uint64_t{0} << (64 - 8 * places);
            const std::uint64_t eight = (load_eight(p + end - 8) & behind_point) |
                                        (load_eight(p + end - 9) & ~behind_point);
            digits = value_of_digits(eight >> (64 - 8 * (whole + places)), whole + places);
        } else {
            digits = static_cast<std::int64_t>(value_of_digits_before(p + point, whole) *
                                               kIntegerPowersOfTen[places]) +
                     value_of_digits_before(p + end, places);
        }
        const double magnitude = static_cast<double>(digits) / kPowersOfTen[places];
        values[k] = negative ? -magnitude : magnitude;
        begin = end + 1;
    }
    const std::uint64_t row = ~std::uint64_t{0} >> (64 - begin);
    return (marks.minus & row) == minus_signs ? p + begin - 1 : nullptr;
#else
    return nullptr;
#endif
}

}  // namespace burin
