#include "mesh/row_kernels.h"

// Compiled with AVX2 and BMI2 where the compiler can (see CMakeLists.txt), and used where the machine can. Only types
// of the compiler and functions of this file may be used here: an inline function from elsewhere that is compiled for
// a newer instruction set might be the one that the linker keeps for all.
#if defined(__AVX2__) && defined(__BMI__) && defined(__BMI2__)

#include <immintrin.h>

namespace burin {
namespace {

std::uint64_t load_eight(const char* p) {
    std::uint64_t bytes;
    __builtin_memcpy(&bytes, p, sizeof bytes);
    return bytes;
}
__m256i load_text(const char* p) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p)); }

/// Bit i: character i is `c`.
std::uint32_t find_equal(__m256i text, char c) {
    return static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(text, _mm256_set1_epi8(c))));
}
/// Bit i: character i is none of 0 1 2 3 4 5 6 7 8 9.
std::uint32_t find_others(__m256i text) {
    const __m256i digit = _mm256_xor_si256(text, _mm256_set1_epi8('0'));
    const __m256i is_digit = _mm256_cmpeq_epi8(_mm256_min_epu8(digit, _mm256_set1_epi8(9)), digit);
    return ~static_cast<std::uint32_t>(_mm256_movemask_epi8(is_digit));
}

/// The last `count` characters before `end`, 1..7, with zeros in front.
std::int64_t load_before(const char* end, unsigned count) {
    const unsigned shift = 64 - 8 * count;
    return static_cast<std::int64_t>(load_eight(end - 8) >> shift << shift);
}

std::size_t triangles(const char*& p, const char* limit, std::size_t max_rows, std::uint32_t* values) {
    const char* row = p;
    const __m256i tens = _mm256_set1_epi16(1 << 8 | 10), hundreds = _mm256_set1_epi32(1 << 16 | 100);
    const __m256i ten_thousands = _mm256_set1_epi32(1 << 16 | 10000);
    for (std::size_t count = 0; count < max_rows; ++count, values += 3) {
        if (row >= limit || row[0] != '3' || row[1] != ' ') return count;
        const char* const q = row + 2;
        const __m256i text = load_text(q);
        const std::uint32_t others = find_others(text);
        const std::uint32_t others_1 = _blsr_u32(others), others_2 = _blsr_u32(others_1);
        const unsigned end_0 = _tzcnt_u32(others), end_1 = _tzcnt_u32(others_1), end_2 = _tzcnt_u32(others_2);
        const unsigned digits_1 = end_1 - end_0 - 1, digits_2 = end_2 - end_1 - 1;
        // The first character that is neither digit nor space: the row's end, perhaps behind a space.
        const unsigned feed = _tzcnt_u32(others & ~find_equal(text, ' '));
        const bool has_sizes =
            (((end_0 - 1) | end_0 | (digits_1 - 1) | digits_1 | (digits_2 - 1) | digits_2) & ~7u) == 0;  // 1..7
        if (!has_sizes || feed - end_2 > 1 || q[feed] != '\n') return count;
        const __m128i two = _mm_set_epi64x(load_before(q + end_1, digits_1), load_before(q + end_0, end_0));
        const __m128i third = _mm_cvtsi64_si128(load_before(q + end_2, digits_2));
        const __m256i digits = _mm256_subs_epu8(_mm256_set_m128i(third, two), _mm256_set1_epi8('0'));
        const __m256i fours = _mm256_madd_epi16(_mm256_maddubs_epi16(digits, tens), hundreds);
        const __m256i eights = _mm256_madd_epi16(_mm256_packus_epi32(fours, fours), ten_thousands);
        _mm_storeu_si64(values, _mm256_castsi256_si128(eights));
        _mm_storeu_si32(values + 2, _mm256_extracti128_si256(eights, 1));
        p = q + end_2;
        row = q + feed + 1;
    }
    return max_rows;
}

constexpr unsigned kMostDigits = 15;
constexpr double kPowers[kMostDigits] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6, 1e7,
                                         1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14};

/// Leaves the point out of sixteen characters, for each number of them that may stand behind it.
struct PointShuffles {
    signed char of[kMostDigits][16] = {};
    constexpr PointShuffles() {
        for (int places = 0; places < static_cast<int>(kMostDigits); ++places) {
            for (int i = 0; i < 16; ++i) of[places][i] = static_cast<signed char>(i < 16 - places ? i - 1 : i);
        }
    }
};
alignas(16) constexpr PointShuffles kPointShuffles;

/// 0xFF for the last `count` of sixteen bytes.
__m128i last_bytes(unsigned count) {
    alignas(32) static constexpr std::uint64_t kTable[] = {0, 0, ~std::uint64_t{0}, ~std::uint64_t{0}};
    return _mm_loadu_si128(reinterpret_cast<const __m128i*>(reinterpret_cast<const char*>(kTable) + count));
}

std::size_t positions(const char*& p, const char* limit, std::size_t max_rows, double* values) {
    const char* row = p;
    for (std::size_t count = 0; count < max_rows; ++count, values += 3) {
        if (row >= limit) return count;
        const __m256i first = load_text(row), second = load_text(row + 32);
        const std::uint64_t minus = find_equal(first, '-') | std::uint64_t{find_equal(second, '-')} << 32;
        std::uint64_t others = (find_others(first) | std::uint64_t{find_others(second)} << 32) & ~minus;
        std::uint64_t minus_signs = 0;
        unsigned begin = 0;
        __m128i fours[3];
        std::uint64_t sign[3];
        double scale[3];
        for (int k = 0; k < 3; ++k) {
            const std::uint64_t negative = minus >> begin & 1;
            const auto point = static_cast<unsigned>(_tzcnt_u64(others));
            others = _blsr_u64(others);
            const auto end = static_cast<unsigned>(_tzcnt_u64(others));
            others = _blsr_u64(others);
            const unsigned whole = point - begin - static_cast<unsigned>(negative), places = end - point - 1;
            // One at least of each; what is less than that is a large number here.
            const bool has_sizes = (((whole - 1) | (places - 1) | (whole + places)) & ~kMostDigits) == 0;
            if (!has_sizes || row[point] != '.' || end > 63) return count;
            if (k < 2 && row[end] != ' ') return count;
            const __m128i text = _mm_loadu_si128(reinterpret_cast<const __m128i*>(row + end - 16));
            const __m128i shuffle = _mm_load_si128(reinterpret_cast<const __m128i*>(kPointShuffles.of[places]));
            const __m128i digits = _mm_and_si128(_mm_shuffle_epi8(_mm_xor_si128(text, _mm_set1_epi8('0')), shuffle),
                                                 last_bytes(whole + places));
            fours[k] =
                _mm_madd_epi16(_mm_maddubs_epi16(digits, _mm_set1_epi16(1 << 8 | 10)), _mm_set1_epi32(1 << 16 | 100));
            scale[k] = kPowers[places];
            sign[k] = negative << 63;
            minus_signs |= negative << begin;
            begin = end + 1;
        }
        const char* const end = row + begin - 1;
        const char* const feed = *end == ' ' ? end + 1 : end;
        if (*feed != '\n' || _bzhi_u64(minus, begin) != minus_signs) return count;
        const __m128i ten_thousands = _mm_set1_epi32(1 << 16 | 10000);
        const __m128i xy = _mm_madd_epi16(_mm_packus_epi32(fours[0], fours[1]), ten_thousands);
        const __m128i z = _mm_madd_epi16(_mm_packus_epi32(fours[2], fours[2]), ten_thousands);
        // Fifteen digits fit a double, so each division is the only rounding.
        const __m256d part = _mm256_set_pd(1, 1e8, 1, 1e8);
        const __m256d magnitudes = _mm256_hadd_pd(_mm256_mul_pd(_mm256_cvtepi32_pd(xy), part),
                                                  _mm256_mul_pd(_mm256_cvtepi32_pd(z), part));  // x z y z
        const __m256d by = _mm256_set_pd(scale[2], scale[1], scale[2], scale[0]);
        const __m256i signs = _mm256_set_epi64x(0, static_cast<long long>(sign[1]), static_cast<long long>(sign[2]),
                                                static_cast<long long>(sign[0]));
        const __m256d xzy = _mm256_xor_pd(_mm256_div_pd(magnitudes, by), _mm256_castsi256_pd(signs));
        const __m128d xz = _mm256_castpd256_pd128(xzy);
        _mm_storel_pd(values, xz);
        _mm_storel_pd(values + 1, _mm256_extractf128_pd(xzy, 1));
        _mm_storeh_pd(values + 2, xz);
        p = end;
        row = feed + 1;
    }
    return max_rows;
}

}  // namespace

const RowKernels* avx2_row_kernels() {
    static constexpr RowKernels kernels{triangles, positions};
    const bool can = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
    return can ? &kernels : nullptr;
}

}  // namespace burin

#else

namespace burin {

const RowKernels* avx2_row_kernels() { return nullptr; }

}  // namespace burin

#endif
