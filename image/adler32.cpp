#include "image/adler32.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cstddef>

namespace burin {
namespace {

constexpr std::uint32_t kModulo = 65521;
constexpr std::size_t kRow = 16, kMaxRows = 256;  // as many as 16 bits can hold the sums of a column of

/// Rows of bytes: the sum of all, the sum over all rows of the sums of the rows before, and the sums of the columns.
struct RowSums {
    std::uint32_t sum, sum_before;
    std::array<std::uint16_t, kRow> columns;
};

RowSums add_rows(const std::uint8_t* p, std::size_t rows) {
    RowSums result{};
#ifdef __SSE2__
    const __m128i zero = _mm_setzero_si128();
    __m128i sum = zero, sum_before = zero, left = zero, right = zero;
    for (; rows > 0; --rows, p += kRow) {
        const __m128i row = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
        sum_before = _mm_add_epi32(sum_before, sum);
        sum = _mm_add_epi32(sum, _mm_sad_epu8(row, zero));  // in two halves
        left = _mm_add_epi16(left, _mm_unpacklo_epi8(row, zero));
        right = _mm_add_epi16(right, _mm_unpackhi_epi8(row, zero));
    }
    const auto total = [](__m128i halves) {
        return static_cast<std::uint32_t>(_mm_cvtsi128_si32(halves) + _mm_cvtsi128_si32(_mm_srli_si128(halves, 8)));
    };
    result.sum = total(sum);
    result.sum_before = total(sum_before);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(result.columns.data()), left);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(result.columns.data() + kRow / 2), right);
#else
    for (; rows > 0; --rows, p += kRow) {
        result.sum_before += result.sum;
        for (std::size_t i = 0; i < kRow; ++i) {
            result.sum += p[i];
            result.columns[i] = static_cast<std::uint16_t>(result.columns[i] + p[i]);
        }
    }
#endif
    return result;
}

}  // namespace

void Adler32::add(std::span<const std::uint8_t> bytes) {
    std::uint64_t a = a_, b = b_;
    while (bytes.size() >= kRow) {
        const std::size_t rows = std::min(kMaxRows, bytes.size() / kRow);
        const RowSums sums = add_rows(bytes.data(), rows);
        b += kRow * rows * a + kRow * std::uint64_t{sums.sum_before};
        for (std::size_t i = 0; i < kRow; ++i) b += (kRow - i) * sums.columns[i];
        a = (a + sums.sum) % kModulo;
        b %= kModulo;
        bytes = bytes.subspan(kRow * rows);
    }
    for (const std::uint8_t byte : bytes) {
        a += byte;
        b += a;
    }
    a_ = static_cast<std::uint32_t>(a % kModulo);
    b_ = static_cast<std::uint32_t>(b % kModulo);
}

void Adler32::add_pairs(const std::uint8_t* pair, std::size_t count) {
    constexpr std::size_t kMost = std::size_t{1} << 24;  // 64 bits hold their sums
    for (; count > 0; count -= std::min(count, kMost)) {
        const std::uint64_t n = std::min(count, kMost), second = n / 2, first = n - second;
        // The byte with i bytes behind it counts i + 1 times.
        const std::uint64_t first_times = first * (n + 1 - first), second_times = second * (n - second);
        const std::uint64_t b = b_ + n * a_ + first_times * pair[0] + second_times * pair[1];
        a_ = static_cast<std::uint32_t>((a_ + first * pair[0] + second * pair[1]) % kModulo);
        b_ = static_cast<std::uint32_t>(b % kModulo);
    }
}

}  // namespace burin
