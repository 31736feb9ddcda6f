#include "image/row_packer.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include <algorithm>
#include <cstring>

namespace burin {
namespace {

/// A pair of bytes, the one of even and the one of odd number.
struct Pair {
    std::uint8_t even, odd;
};
Pair last_pair(std::span<const std::uint8_t> bytes) { return {bytes[bytes.size() - 2], bytes[bytes.size() - 1]}; }

std::uint8_t difference(std::uint8_t value, std::uint8_t before) {
    return static_cast<std::uint8_t>(value - before + 128);
}

/// The places where pairs of bytes go to.
struct PairPlace {
    std::uint8_t *even, *odd;
};

/// Puts pairs, which follow `before`.
void put(PairPlace to, std::span<const std::uint8_t> bytes, Pair before) {
    const std::uint8_t* p = bytes.data();
    const std::uint8_t* const end = p + bytes.size();
#ifdef __SSE2__                                                       // the compiler's own vectors take each pair twice
    __m128i last = _mm_cvtsi32_si128(before.even | before.odd << 8);  // pair, and nothing else
    const __m128i low = _mm_set1_epi16(0xFF), center = _mm_set1_epi8(static_cast<char>(128));
    const auto differences = [&](const std::uint8_t* at) {
        const __m128i pairs = _mm_loadu_si128(reinterpret_cast<const __m128i*>(at));
        const __m128i shifted = _mm_or_si128(_mm_slli_si128(pairs, 2), last);
        last = _mm_srli_si128(pairs, 14);
        return _mm_add_epi8(_mm_sub_epi8(pairs, shifted), center);
    };
    for (; end - p >= 32; p += 32, to.even += 16, to.odd += 16) {
        const __m128i a = differences(p), b = differences(p + 16);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to.even),
                         _mm_packus_epi16(_mm_and_si128(a, low), _mm_and_si128(b, low)));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to.odd),
                         _mm_packus_epi16(_mm_srli_epi16(a, 8), _mm_srli_epi16(b, 8)));
    }
    if (p > bytes.data()) before = {p[-2], p[-1]};
#endif
    for (; p < end; p += 2) {
        *to.even++ = difference(p[0], before.even);
        *to.odd++ = difference(p[1], before.odd);
        before = {p[0], p[1]};
    }
}

/// From here on the bytes of put_turns() are those two before.
constexpr std::size_t kRunStart = 3;

/// Puts `a` and `b` in turns: from the second byte on, so do differences.
void put_turns(std::uint8_t* to, std::size_t count, std::uint8_t a, std::uint8_t b, std::uint8_t before) {
    const std::uint8_t forth = difference(b, a), back = difference(a, b);
    to[0] = difference(a, before);
    if (forth == back) {
        std::memset(to + 1, forth, count - 1);
        return;
    }
    std::uint8_t turns[8];
    for (std::size_t i = 0; i < 8; ++i) turns[i] = i % 2 == 0 ? forth : back;
    std::size_t i = 1;
    for (; i + 8 <= count; i += 8) std::memcpy(to + i, turns, 8);
    std::memcpy(to + i, turns, count - i);
}

/// Puts `pairs` pairs of pixels of 2 or 4 bytes that are all the same.
void put_repeated(PairPlace to, std::size_t pairs, std::span<const std::uint8_t> pixel, Pair before) {
    const Pair first{pixel[0], pixel[1]}, second = last_pair(pixel);  // may be the same
    put_turns(to.even, pairs, first.even, second.even, before.even);
    put_turns(to.odd, pairs, first.odd, second.odd, before.odd);
}

const std::uint8_t* bytes_of(const std::byte* p) { return reinterpret_cast<const std::uint8_t*>(p); }

}  // namespace

RowPacker::RowPacker(const ImageStrip& strip, std::span<const PixelType> types, std::span<const std::size_t> order,
                     int first_row, int end_row)
    : strip_(strip),
      first_row_(static_cast<std::size_t>(first_row)),
      rows_(static_cast<std::size_t>(end_row - first_row)) {
    const auto width = static_cast<std::size_t>(strip.data.width());
    for (std::size_t i = 0, x = 0; i < strip.blocks.size(); ++i) {
        const std::size_t end = std::min(width, x + static_cast<std::size_t>(strip.block_width));
        if (strip.blocks[i] == nullptr && !parts_.empty() && parts_.back().block == nullptr) {
            parts_.back().width += end - x;
        } else {
            parts_.push_back({strip.blocks[i], x, end - x});
        }
        x = end;
    }
    for (const std::size_t c : order) {
        planes_.push_back({c, size_of(types[c]), row_size_});
        row_size_ += width * size_of(types[c]);
    }
}

RowPacker::PartRows RowPacker::rows_of(const Part& part, const Plane& plane) const {
    if (part.block == nullptr) return {bytes_of(strip_.background[plane.channel].data()), 0, plane.pixel_size};
    const std::size_t size = part.width * plane.pixel_size;
    return {bytes_of(part.block->channels()[plane.channel].bytes.data()) + first_row_ * size, size, size};
}

void RowPacker::raw(std::vector<std::uint8_t>& bytes) const {
    bytes.clear();
    for (std::size_t y = 0; y < rows_; ++y) {
        for (const Plane& plane : planes_) {
            for (const Part& part : parts_) {
                const std::span<const std::uint8_t> row = rows_of(part, plane).row(y);
                for (std::size_t left = part.width * plane.pixel_size; left > 0; left -= row.size())
                    bytes.insert(bytes.end(), row.begin(), row.end());
            }
        }
    }
}

std::span<const std::uint8_t> RowPacker::row_before(std::size_t part, std::size_t plane, std::size_t y) const {
    if (part > 0) return rows_of(parts_[part - 1], planes_[plane]).row(y);
    if (plane > 0) return rows_of(parts_.back(), planes_[plane - 1]).row(y);
    if (y > 0) return rows_of(parts_.back(), planes_.back()).row(y - 1);
    static constexpr std::uint8_t kStart[] = {128, 0};  // the first byte stays what it is
    return kStart;
}

void RowPacker::packed(UnfilledVector<std::uint8_t>& bytes, std::vector<Deflater::Run>& runs) const {
    bytes.resize(size());
    std::uint8_t *const even = bytes.data(), *const odd = even + size() / 2;
    const auto place_of = [&](const Part& part, const Plane& plane, std::size_t y) {
        return (y * row_size_ + plane.place + part.x * plane.pixel_size) / 2;
    };
    runs.clear();
    for (std::size_t y = 0; y < rows_; ++y) {
        for (std::size_t k = 0; k < planes_.size(); ++k) {
            for (std::size_t i = 0; i < parts_.size(); ++i) {
                const Part& part = parts_[i];
                if (part.block != nullptr) continue;
                const std::size_t place = place_of(part, planes_[k], y), pairs = part.width * planes_[k].pixel_size / 2;
                put_repeated({even + place, odd + place}, pairs, rows_of(part, planes_[k]).row(y),
                             last_pair(row_before(i, k, y)));
                if (pairs > kRunStart) runs.push_back({place + kRunStart, place + pairs});
            }
        }
    }
    const std::size_t count = runs.size();
    for (std::size_t i = 0; i < count; ++i) runs.push_back({size() / 2 + runs[i].begin, size() / 2 + runs[i].end});
    // Rows are taken part by part, for in memory a part's rows follow each other.
    for (std::size_t i = 0; i < parts_.size(); ++i) {
        const Part& part = parts_[i];
        if (part.block == nullptr) continue;
        for (std::size_t k = 0; k < planes_.size(); ++k) {
            const PartRows rows = rows_of(part, planes_[k]),
                           next = rows_of(part, planes_[std::min(k + 1, planes_.size() - 1)]);
            for (std::size_t y = 0; y < rows_; ++y) {
                // The next plane is prefetched, for the processor cannot tell where it is.
                for (std::size_t at = 0; at < next.size; at += 64) __builtin_prefetch(next.row(y).data() + at);
                const std::size_t place = place_of(part, planes_[k], y);
                put({even + place, odd + place}, rows.row(y), last_pair(row_before(i, k, y)));
            }
        }
    }
    // The odd bytes follow the even ones.
    const std::uint8_t last_even = last_pair(rows_of(parts_.back(), planes_.back()).row(rows_ - 1)).even;
    *odd = difference(static_cast<std::uint8_t>(*odd - 128), last_even);  // it was the difference to 0
}

}  // namespace burin
