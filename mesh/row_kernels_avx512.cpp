#include "mesh/row_kernels.h"

// Compiled with AVX-512, VBMI2 and BMI2 where the compiler can (see CMakeLists.txt), and used where the machine can. As
// in row_kernels_avx2.cpp, only types of the compiler and functions of this file may be used here.
#if defined(__AVX512BW__) && defined(__AVX512DQ__) && defined(__AVX512VL__) && defined(__AVX512VBMI__) && \
    defined(__AVX512VBMI2__) && defined(__BMI__) && defined(__BMI2__)

#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"  // of what GCC's own functions leave open on purpose
#include <immintrin.h>

namespace burin {
namespace {

/// Sixty-four bytes: byte_of(i) for each i.
template <auto byte_of>
__m512i bytes_of() {
    struct alignas(64) Bytes {
        signed char of[64] = {};
        constexpr Bytes() {
            for (int i = 0; i < 64; ++i) of[i] = static_cast<signed char>(byte_of(i));
        }
    };
    static constexpr Bytes kBytes;
    return _mm512_load_si512(kBytes.of);
}

template <signed char value>
__m512i all_bytes() {
    return bytes_of<[](int) { return value; }>();
}

/// Bit i: character i, less '0', is none of the digits.
std::uint64_t find_others(__m512i characters) { return _mm512_cmpgt_epu8_mask(characters, all_bytes<9>()); }

/// Sets of up to eight places among 64, as bytes in ascending order.
__m512i places_of(std::uint64_t set) {
    return _mm512_maskz_compress_epi8(set, bytes_of<[](int i) { return i; }>());
}

/// Digits in groups of four, each as a number.
__m512i fours_of(__m512i digits) {
    return _mm512_madd_epi16(_mm512_maddubs_epi16(digits, _mm512_set1_epi16(1 << 8 | 10)),
                             _mm512_set1_epi32(1 << 16 | 100));
}
/// Numbers of eight digits; each pair of them stands twice.
__m512i eights_of(__m512i fours) {
    return _mm512_madd_epi16(_mm512_packus_epi32(fours, fours), _mm512_set1_epi32(1 << 16 | 10000));
}

/// The place behind the last number of a row that ends in front of `next`.
const char* behind_last(const char* next) { return next[-2] == ' ' ? next - 2 : next - 1; }

/// Lets another kernel read on from `row`.
template <typename Value>
std::size_t read_on(std::size_t (*read)(const char*&, const char*, std::size_t, Value*), const char*& p,
                    const char* row, const char* limit, std::size_t max_rows, Value* values) {
    const std::size_t count = read(row, limit, max_rows, values);
    if (count > 0) p = row;
    return count;
}

std::size_t triangles(const char*& p, const char* limit, std::size_t max_rows, std::uint32_t* values) {
    constexpr std::ptrdiff_t kLongestRow =
        2 + 8 + 8 + 7 + 2;  // "3 A B C " and a feed, seven digits each; two are among 64 characters
    const char* row = p;
    std::size_t count = 0;
    for (; count + 2 <= max_rows && limit - row > kLongestRow; count += 2, values += 6) {
        const __m512i text = _mm512_loadu_si512(row), characters = _mm512_sub_epi8(text, all_bytes<'0'>());
        const std::uint64_t others = find_others(characters), spaces = _mm512_cmpeq_epi8_mask(text, all_bytes<' '>()),
                            feeds = _mm512_cmpeq_epi8_mask(text, all_bytes<'\n'>());
        const std::uint64_t second_feed = _blsr_u64(feeds), first_row = _blsmsk_u64(feeds),
                            both_rows = _blsmsk_u64(second_feed);
        // Numbers end at what is no digit, but for a feed behind a space.
        const std::uint64_t behind_others = others << 1 | 1, ends = others & ~behind_others & both_rows;
        const std::uint64_t wrong = others & ~feeds & ~(spaces & ~behind_others) & both_rows;
        if (second_feed == 0 || wrong != 0 || _mm_popcnt_u64(ends) != 8 || _mm_popcnt_u64(ends & first_row) != 4) break;
        const __m512i number_of_byte = bytes_of<[](int i) { return i / 8; }>();
        const __m512i end = _mm512_permutexvar_epi8(number_of_byte, places_of(ends));
        const __m512i begin = _mm512_permutexvar_epi8(number_of_byte, places_of(behind_others & ~others));
        // One digit, and three times one to seven of them.
        const __m512i digits_behind_first = _mm512_sub_epi8(_mm512_sub_epi8(end, begin), all_bytes<1>());
        if (_mm512_cmpgt_epu8_mask(digits_behind_first, bytes_of<[](int i) { return i / 8 % 4 == 0 ? 0 : 6; }>()) != 0)
            break;
        const __m512i from = _mm512_add_epi8(end, bytes_of<[](int i) { return i % 8 - 8; }>());
        const __m512i digits = _mm512_maskz_permutexvar_epi8(_mm512_cmpge_epi8_mask(from, begin), from, characters);
        const __m512i numbers = eights_of(fours_of(digits));  // 3 A 3 A, B C B C, and the same of the second row
        if ((_mm512_cmpeq_epi32_mask(numbers, _mm512_set1_epi32(3)) & 0x0101) != 0x0101) break;
        const __m512i corners =
            _mm512_permutexvar_epi32(_mm512_setr_epi32(1, 4, 5, 9, 12, 13, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0), numbers);
        _mm256_mask_storeu_epi32(values, 0x3F, _mm512_castsi512_si256(corners));
        row += _tzcnt_u64(second_feed) + 1;
    }
    if (count > 0) p = behind_last(row);
    return count + read_on(avx2_row_kernels()->triangles, p, row, limit, max_rows - count, values);
}

std::size_t positions(const char*& p, const char* limit, std::size_t max_rows, double* values) {
    const char* row = p;
    std::size_t count = 0;
    for (; count < max_rows && row < limit; ++count, values += 3) {
        const __m512i text = _mm512_loadu_si512(row), characters = _mm512_sub_epi8(text, all_bytes<'0'>());
        const std::uint64_t feeds = _mm512_cmpeq_epi8_mask(text, all_bytes<'\n'>()),
                            minus = _mm512_cmpeq_epi8_mask(text, all_bytes<'-'>());
        const std::uint64_t others = find_others(characters) & ~minus;
        // A point in each number and a gap behind it, and perhaps a space in front of the feed.
        const std::uint64_t begins = _pdep_u64(0b101010, others) << 1 | 1;
        const auto other = static_cast<std::uint64_t>(
            _mm_cvtsi128_si64(_mm512_castsi512_si128(_mm512_maskz_compress_epi8(others, text))));
        constexpr std::uint64_t kWithSpace = 0x0A202E202E202E, kWithout = 0x0A2E202E202E;  // ". . . \n" and ". . .\n"
        const bool has_space = (others << 1 & feeds & _blsmsk_u64(feeds)) != 0;
        if (_bzhi_u64(other, has_space ? 56 : 48) != (has_space ? kWithSpace : kWithout)) break;
        if ((minus & ~begins & _blsmsk_u64(feeds)) != 0) break;
        const auto negative = static_cast<__mmask8>(_pext_u64(minus, begins));
        const __m512i places = places_of(others);
        // Where the point and the end of each number are, in 64 bits each.
        const __m256i point_and_end = _mm256_cvtepu16_epi64(_mm512_castsi512_si128(places)),
                      end = _mm256_srli_epi64(point_and_end, 8);
        const __m256i point = _mm256_and_si256(point_and_end, _mm256_set1_epi64x(0xFF)), one = _mm256_set1_epi64x(1);
        const __m256i begin = _mm256_maskz_add_epi64(0b1110, _mm256_permute4x64_epi64(end, 0b10'01'00'00), one);
        const __m256i from_begin = _mm256_sub_epi64(point, begin),
                      whole = _mm256_mask_sub_epi64(from_begin, negative, from_begin, one);
        const __m256i behind = _mm256_sub_epi64(_mm256_sub_epi64(end, point), one);
        // One digit at least on either side, 15 at most; what is less than one is a large number here.
        const __m256i sizes =
            _mm256_or_si256(_mm256_or_si256(_mm256_sub_epi64(whole, one), _mm256_sub_epi64(behind, one)),
                            _mm256_add_epi64(whole, behind));
        if ((_mm256_test_epi64_mask(sizes, _mm256_set1_epi64x(~15)) & 0b111) != 0) break;
        // The last sixteen characters of each number, but for its point. A minus is 0.
        const __m512i back =
            _mm512_add_epi8(_mm512_permutexvar_epi8(bytes_of<[](int i) { return i / 16 * 2 + 1; }>(), places),
                            bytes_of<[](int i) { return i % 16 - 16; }>());
        const __mmask64 is_whole =
            _mm512_cmple_epi8_mask(back, _mm512_permutexvar_epi8(bytes_of<[](int i) { return i / 16 * 2; }>(), places));
        const __m512i from = _mm512_mask_sub_epi8(back, is_whole, back, all_bytes<1>());
        const __m512i end_before = _mm512_mask_permutexvar_epi8(
            all_bytes<-1>(), ~std::uint64_t{0xFFFF}, bytes_of<[](int i) { return i / 16 * 2 - 1; }>(), places);
        const __m512i digits = _mm512_maskz_permutexvar_epi8(_mm512_cmpgt_epi8_mask(from, end_before), from,
                                                             _mm512_subs_epu8(text, all_bytes<'0'>()));
        const __m512i eights = eights_of(fours_of(digits));
        const __m512i integers =
            _mm512_add_epi64(_mm512_mul_epu32(eights, _mm512_set1_epi64(100000000)), _mm512_srli_epi64(eights, 32));
        const __m256i xyz =
            _mm512_castsi512_si256(_mm512_permutexvar_epi64(_mm512_setr_epi64(0, 2, 4, 4, 4, 4, 4, 4), integers));
        const __m256d by = _mm512_castpd512_pd256(_mm512_permutex2var_pd(
            _mm512_setr_pd(1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7), _mm512_castsi256_si512(behind),
            _mm512_setr_pd(1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15)));
        // Fifteen digits fit a double, so the division is the only rounding.
        const __m256d magnitudes = _mm256_div_pd(_mm256_cvtepi64_pd(xyz), by);
        _mm256_mask_storeu_pd(values, 0b111,
                              _mm256_mask_xor_pd(magnitudes, negative, magnitudes, _mm256_set1_pd(-0.0)));
        row += _tzcnt_u64(feeds) + 1;
    }
    if (count > 0) p = behind_last(row);
    return count + read_on(avx2_row_kernels()->positions, p, row, limit, max_rows - count, values);
}

}  // namespace

const RowKernels* avx512_row_kernels() {
    static constexpr RowKernels kernels{triangles, positions};
    const bool can = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
                     __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
                     __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vbmi2") &&
                     __builtin_cpu_supports("popcnt") && avx2_row_kernels() != nullptr;
    return can ? &kernels : nullptr;
}

}  // namespace burin

#else

namespace burin {

const RowKernels* avx512_row_kernels() { return nullptr; }

}  // namespace burin

#endif
